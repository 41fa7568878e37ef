#pragma once

#include <array>

namespace window_ingress::detection {

/// Stages that the processing time of one image is divided into, in the order of the pipeline.
enum class Stage {
  kTrack,       ///< tracking a known window
  kPreprocess,  ///< pyramid, blur, equalisation
  kEdges,       ///< gradients and edge pixels
  kLines,       ///< runs and straight segments
  kOutlines,    ///< closing, contours, polygons
  kCandidates,  ///< quadrilaterals of segments, gates, side support
  kReference,   ///< comparing with the reference, nested loops
  kBorders      ///< fitting borders in the full image
};
constexpr int kStages = static_cast<int>(Stage::kBorders) + 1;

inline const char* toString(Stage stage) {
  constexpr std::array<const char*, kStages> kNames = {"track",    "preprocess", "edges",     "lines",
                                                       "outlines", "candidates", "reference", "borders"};
  return kNames[static_cast<int>(stage)];
}

/// Adds up the time of each stage of one image. The detector has no clock: a caller who wants times provides
/// one.
class StageTimer {
 public:
  using Clock = double (*)();  ///< seconds that never go back

  explicit StageTimer(Clock clock) : clock_(clock) {}

  /// A new image.
  void begin() {
    sec_.fill(0.0);
    last_sec_ = clock_();
  }
  /// All time since the last call was spent in this stage.
  void done(Stage stage) {
    const double now_sec = clock_();
    sec_[static_cast<int>(stage)] += now_sec - last_sec_;
    last_sec_ = now_sec;
  }
  double milliseconds(Stage stage) const { return 1e3 * sec_[static_cast<int>(stage)]; }

 private:
  Clock clock_;
  double last_sec_ = 0.0;
  std::array<double, kStages> sec_{};
};

/// For callers whose timer may be null.
inline void done(StageTimer* timer, Stage stage) {
  if (timer) timer->done(stage);
}

}  // namespace window_ingress::detection
