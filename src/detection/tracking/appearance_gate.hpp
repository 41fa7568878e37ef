#pragma once

namespace window_ingress::detection {

/// How like the reference the target has been: a window that is much less so does not take its place while it
/// is out of sight. The limit of `AppearanceMatch` must let the target pass in any light; of two that pass in
/// the same light, one that is clearly less like it is another window.
class AppearanceGate {
 public:
  static constexpr double kMargin =
      0.2;  ///< a window less like the reference than the target was by this is another one
  static constexpr double kValidSec = 10.0;  ///< a comparison says what is allowed for so long [s]

  void forget() { *this = AppearanceGate(); }
  /// Bhattacharyya distance of a confirmed track, at a comparison.
  void note(double distance, double stamp_sec);
  /// Whether a window at this distance may be the target. Anything may where nothing is known, or once the
  /// target has been out of sight for `kValidSec`: the light may be another.
  bool allows(double distance, double stamp_sec) const;

  double best() const { return best_; }  ///< of the target so far, smoothed; 2 where nothing is known

 private:
  static constexpr double kUnknown = 2.0;

  double best_ = kUnknown, smoothed_ = 0.0, last_sec_ = 0.0;
  int notes_ = 0;
};

}  // namespace window_ingress::detection
