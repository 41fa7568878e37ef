#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <deque>
#include <optional>

namespace window_ingress::estimation {

/// Checks the stated size of a window in the first half metre of motion across the line of sight. From one
/// place, a window half as large and half as far away looks the same. When the camera moves by b, the place
/// computed with the wrong size moves by b (1 - 1/k), where k is the true size over the stated one. This is
/// quicker than `MountingCheck`, which must learn everything else, too. It is meant for windows much smaller
/// than stated: 1 - 1/k cannot distinguish much larger ones.
class ParallaxCheck {
 public:
  /// \param target_speed_mps speed at which the window itself may move; such motion proves nothing
  explicit ParallaxCheck(double target_speed_mps = 0.0) : target_speed_mps_(target_speed_mps) {}

  /// Drift of odometry, per axis; 0.02 until told, and at least. [m/sqrt(s)]
  void assumeDrift(double m_per_sqrt_sec) { drift_m_per_sqrt_sec_ = std::max(kLeastDrift, m_per_sqrt_sec); }
  /// Adds one image. \param camera_odom_m camera position \param window_odom_m the window's centre, computed
  /// with the stated size. Ignored if not finite, or not later than the last.
  void see(double stamp_sec, const Eigen::Vector3d& camera_odom_m, const Eigen::Vector3d& window_odom_m);
  /// Call for another window or another odometry frame.
  void clear() { *this = ParallaxCheck(target_speed_mps_); }

  /// True size over the stated one, if that is certainly another; until it is certainly the same.
  std::optional<double> otherFactor() const { return other_factor_; }

 private:
  static constexpr double kLeastDrift = 0.02;
  struct Sight {
    double stamp_sec;
    Eigen::Vector3d camera, window;
  };
  bool isNew(double stamp_sec, const Eigen::Vector3d& camera_odom_m) const;
  void judge();

  double target_speed_mps_, drift_m_per_sqrt_sec_ = kLeastDrift;
  std::deque<Sight> sights_;
  std::optional<double> other_factor_;
};

}  // namespace window_ingress::estimation
