#pragma once

#include <array>

namespace window_ingress::detection {

/// What the time of one image went into, in the order of the pipeline.
enum class Stage {
  kTrack,       ///< following a window that is known
  kPreprocess,  ///< pyramid, blur, equalisation
  kEdges,       ///< gradients and edge pixels
  kLines,       ///< runs and straight segments
  kOutlines,    ///< closing, contours, polygons
  kCandidates,  ///< quadrilaterals of segments, gates, side support
  kReference,   ///< comparing with the reference, nested loops
  kBorders      ///< fitting borders in the full image
};
constexpr int kStages = static_cast<int>(Stage::kBorders) + 1;

const char* toString(Stage stage);

/// Adds up the time of each stage of one image. The detector has no clock of its own: who wants times gives
/// one.
class StageTimer {
 public:
  using Clock = double (*)();  ///< seconds that never go back

  explicit StageTimer(Clock clock) : clock_(clock) {}

  void begin();            ///< a new image
  void done(Stage stage);  ///< all time since the last call was spent in this stage
  double milliseconds(Stage stage) const { return 1e3 * sec_[static_cast<int>(stage)]; }

 private:
  Clock clock_;
  double last_sec_ = 0.0;
  std::array<double, kStages> sec_{};
};

/// For those who may have been given none.
inline void done(StageTimer* watch, Stage stage) {
  if (watch) watch->done(stage);
}

}  // namespace window_ingress::detection
