#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "detection/alignment/homography_sums.hpp"
#include "detection/alignment/rectangle_prior.hpp"
#include "detection/alignment/ring_score.hpp"
#include "detection/alignment/ring_view.hpp"
#include "window_ingress/detection/border_refinement.hpp"

namespace window_ingress::detection {

/// Where the ring fits best.
struct AlignedRing {
  geometry::Quadrilateral quad;  ///< order as the start, pixels of the image as it came
  RingMatch match;
  /// How well its sides are known, in that order; that of a frame from beyond which the camera looks is not,
  /// nor one beside which less than half of the ring is in the image.
  std::array<SideSigma, 4> sides;
  std::optional<int> hidden;  ///< side before which something stands: known by the three others alone
};

/// Compares the reference's ring with places in an image, and moves a quadrilateral to where it fits best:
/// Gauss and Newton on the homography, inverse compositional, coarse to fine, with robust weights. A segment
/// of the ring has a gain and, channel by channel, an offset of its own: exposure, white balance and cast
/// shadows change nothing. Keeps its memory; one object a thread.
class RingAlignment {
 public:
  /// \param model, image outlive the comparisons \param camera null: the image is taken as free of distortion
  /// \param covered something stands before the ring: what does not fit is left out from the beginning
  void set(const RingModel& model, const cv::Mat& image, const geometry::PinholeCamera* camera,
           bool covered = false);

  /// \param side_px resolution at which they are compared, at most [px a mean side]
  RingMatch compare(const geometry::Quadrilateral& quad, double side_px);

  /// The same, and what it says where something stands before the ring: samples that differ far more than
  /// most count less. In the dark at half the resolution, which averages the noise.
  RingMatch judge(const geometry::Quadrilateral& quad, double side_px);

  /// Nothing if it runs away from the start. \param finest_px, coarsest_px resolutions at which it ends and
  /// begins: the coarser, the further off a start may be
  std::optional<AlignedRing> align(const geometry::Quadrilateral& start, double finest_px,
                                   double coarsest_px);

  /// Where the ring lies if this is no view of the opening because the edge of something before one side was
  /// taken for its border: without that side. Nothing where all sides fit, or it does not help.
  std::optional<AlignedRing> uncovered(const geometry::Quadrilateral& quad, double finest_px);

  /// With this side where it must lie by the three others; nothing where the opening's shape is not known.
  /// \param quad pixels of the image as it came, order as the reference's
  std::optional<geometry::Quadrilateral> completed(const geometry::Quadrilateral& quad, int side) const;

 private:
  /// Weighted products of the slopes (a, b) of some samples, their residuals r and the ring's values x: of
  /// all channels, and the slopes of each.
  struct SlopeProducts {
    static constexpr int kMost = 32;
    using Each = std::array<float, kMost>;
    Each aa{}, ab{}, bb{}, ar{}, br{}, ax{}, bx{};
    std::array<Each, kRingChannels> a, b;
  };
  SlopeProducts products(const RingSegment& segment, int begin, int count) const;
  void accumulate(const RingSegment& segment, NormalSum& normal, DerivativeSum& right, Matrix8f& explained);
  int sideOf(int segment) const { return 4 * segment / view_.ring().segmentCount(); }
  double beyondChance(double correlation) const;
  double partInView(int side) const;
  void readSegments();
  std::optional<int> hiddenSide() const;
  std::optional<Eigen::Matrix3d> change(const Eigen::Matrix3d& map);
  RingMatch refine(const RingView::Scale& scale, const geometry::Quadrilateral& start, Eigen::Matrix3d& map,
                   int most_steps);
  std::array<SideSigma, 4> sidesOf(const Eigen::Matrix3d& map) const;

  RingView view_;
  RingScore judgement_;
  std::optional<RectanglePrior> prior_;
  bool leaves_out_ = false;    ///< what may be covered: a rectangle of known shape is known by three sides
  std::optional<int> hidden_;  ///< side that is left out
  RingCorrelation correlation_;
  std::vector<RingSegment> segments_;
  std::vector<WeightedPart> parts_;
  std::vector<float> residuals_;
  Matrix8f normal_;       ///< of the last change
  Matrix8f information_;  ///< of the best map, from its change and the spread of what was left
  float spread_ = 0.1F;   ///< of the residuals
};

}  // namespace window_ingress::detection
