#pragma once

#include <Eigen/Core>
#include <deque>

namespace window_ingress::estimation {

/// Whether a window is as large as it is said to be, from the first half metre of motion across the line of
/// sight. From one place a window half as large and half as far away looks the same; but as the camera moves
/// by b, its place as computed with the wrong size moves by b (1 - 1/k), k being its true size over the one
/// said. Quicker than `MountingCheck`, which must learn all else too, and made for what is much smaller
/// than said: 1 - 1/k cannot tell much larger ones.
class ParallaxCheck {
 public:
  /// \param target_speed_mps at which the window itself may move: what it may have moved proves nothing
  explicit ParallaxCheck(double target_speed_mps = 0.0) : target_speed_mps_(target_speed_mps) {}

  enum class Verdict { kOpen, kAsSaid, kOther };

  /// One image's answer. \param camera_odom_m where it was taken \param window_odom_m the window's centre as
  /// computed with the size said. Not finite, or not later than the last: ignored.
  void see(double stamp_sec, const Eigen::Vector3d& camera_odom_m, const Eigen::Vector3d& window_odom_m);
  /// Another window, or another odometry frame.
  void clear() { *this = ParallaxCheck(target_speed_mps_); }

  Verdict verdict() const { return verdict_; }
  double factor() const { return factor_; }  ///< true size over the one said; only with a verdict

 private:
  struct Sight {
    double stamp_sec;
    Eigen::Vector3d camera, window;
  };
  bool isNew(double stamp_sec, const Eigen::Vector3d& camera_odom_m) const;
  void judge();

  double target_speed_mps_;
  std::deque<Sight> sights_;
  Verdict verdict_ = Verdict::kOpen;
  double factor_ = 1.0;
};

}  // namespace window_ingress::estimation
