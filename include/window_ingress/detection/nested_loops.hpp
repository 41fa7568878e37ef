#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "window_ingress/detection/candidate.hpp"

namespace window_ingress::detection {

struct NestedLoopsParams {
  double max_ring = 0.25;        ///< width of a frame, in mean sides of its outer border
  double ring_ratio = 3.0;       ///< widest over narrowest side of a frame
  double uniform = 22.0;         ///< colours of a frame's four sides differ less than this [grey levels]
  double container_score = 1.0;  ///< a loop round panes wins if its score is at least this part of theirs
  double max_panes = 40.0;       ///< area of a window over the area of its smallest pane

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_ring", self.max_ring, 0.0, 0.5);
    field("ring_ratio", self.ring_ratio, 1.0, 100.0);
    field("uniform", self.uniform, 0.0, 442.0);
    field("container_score", self.container_score, 0.0, 10.0);
    field("max_panes", self.max_panes, 1.0, 1000.0);
  }
};

/// Spread of the colours of the ring between two loops: of its four sides about their mean or of one side
/// along itself, the larger [grey levels].
double ringSpread(const cv::Mat& image, const geometry::Quadrilateral& outer,
                  const geometry::Quadrilateral& inner);

/// True if `inner` lies within `outer` with a border of about the same width all round.
/// \param tolerance_px uncertainty of that width [px]
bool isConcentric(const geometry::Quadrilateral& outer, const geometry::Quadrilateral& inner,
                  double tolerance_px, const NestedLoopsParams& params);

/// What the loops of a scene are to each other.
struct LoopVerdict {
  RejectReason reject = RejectReason::kNone;  ///< kOuterBorder, kPane, or kNone
  int other = -1;                             ///< the loop that is taken in its place
  bool framed = false;                        ///< it is the inner border of a frame that was seen
};

/// Chooses among loops that lie in each other. Of loops round the same centre the front inner border of the
/// opening wins: from the outermost loop inwards as long as the ring passed over is uniform, as the four
/// sides of a frame are (same plane, same paint) and those of a reveal are not. Without a uniform ring there
/// is no frame: the outermost loop is the opening's front. A loop that holds panes wins over each of them.
class NestedLoops {
 public:
  explicit NestedLoops(const NestedLoopsParams& params) : params_(params) {}

  /// \param quads in pixels of `image`; scores in the same order
  /// \param tolerance_px uncertainty of a loop's position [px]
  std::vector<LoopVerdict> run(const cv::Mat& image, const std::vector<geometry::Quadrilateral>& quads,
                               const std::vector<double>& scores, double tolerance_px) const;

 private:
  NestedLoopsParams params_;
};

}  // namespace window_ingress::detection
