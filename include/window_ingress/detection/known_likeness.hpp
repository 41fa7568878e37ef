#pragma once

#include "window_ingress/detection/track_params.hpp"

namespace window_ingress::detection {

/// How like the reference the target has been: a window that is much less so does not take its place while it
/// is out of sight. The limit of `AppearanceMatch` must let the target pass in any light; of two that pass in
/// the same light, one that is clearly less like it is another window.
class KnownLikeness {
 public:
  explicit KnownLikeness(const TrackParams& params) : params_(params) {}

  void forget() { *this = KnownLikeness(params_); }
  /// Bhattacharyya distance of a confirmed track, at a comparison.
  void note(double distance, double stamp_sec);
  /// Whether a window at this distance may be the target. Anything may where nothing is known, or once the
  /// target has been out of sight for `TrackParams::likeness_sec`: the light may be another.
  bool allows(double distance, double stamp_sec) const;

  double best() const { return best_; }  ///< of the target so far, smoothed; 2 where nothing is known

 private:
  static constexpr double kUnknown = 2.0;

  TrackParams params_;
  double best_ = kUnknown, smoothed_ = 0.0, last_sec_ = 0.0;
  int notes_ = 0;
};

}  // namespace window_ingress::detection
