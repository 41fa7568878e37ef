#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

namespace window_ingress::estimation {

/// Measures the difference between the stamps of images and of odometry. While a camera turns relative to a
/// standing window at rate w, a pose at a stamp that is late by d has turned further by w d, and so has the
/// apparent direction of the window. d is the slope of that shift over w, from their changes within a
/// fraction of a second: positions and the window's estimate err steadily for longer, so their errors drop
/// out. It needs a turn that begins or ends while the window is seen whole, as after every search.
class ClockCheck {
 public:
  /// One image of the window, whole.
  struct Sight {
    double stamp_sec = 0.0;
    Eigen::Vector2d camera_odom_m = Eigen::Vector2d::Zero();      ///< by odometry at the stamp, from above
    Eigen::Vector2d velocity_odom_mps = Eigen::Vector2d::Zero();  ///< of the camera, by odometry's twist
    double azimuth_rad = 0.0;                                     ///< direction of the window, odom axes
    double yaw_rate_radps = 0.0;                                  ///< by odometry's twist
  };
  struct Offset {
    double late_sec = 0.0;  ///< stamps of images relative to those of odometry; negative: early
    double sigma_sec = 0.0;
    /// True if it indicates a wrong clock or driver.
    bool isTooLarge() const;
  };

  /// Ignores values that are not finite.
  /// \param window_odom_m estimated position of the window, seen from above
  void see(const Sight& sight, const Eigen::Vector2d& window_odom_m);
  /// The odometry frame or the window changed; the offset found so far stays.
  void forgetPlaces() { recent_.clear(); }
  void clear() { *this = ClockCheck(); }

  /// Nothing before the first turn.
  const std::optional<Offset>& offset() const { return offset_; }

 private:
  void addChange(double rate, double shift, double elapsed_sec);

  std::deque<Sight> recent_;
  /// Weighted sums over independent changes of rate (r) and shift (s).
  double count_ = 0.0, rr_ = 0.0, rs_ = 0.0, ss_ = 0.0;
  std::optional<Offset> offset_;
};

}  // namespace window_ingress::estimation
