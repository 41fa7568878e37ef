#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

namespace window_ingress::estimation {

/// Measures the difference between the stamps of images and of odometry. While a vehicle turns at rate w,
/// odometry at a stamp that is late by d has turned further by w d, and so has the apparent direction of a
/// standing window. The slope of that shift over the rate is d. It needs a turn that begins or ends while the
/// window is seen whole, as after every search.
class ClockCheck {
 public:
  /// One image of the window, whole.
  struct Sight {
    double stamp_sec = 0.0;
    Eigen::Vector2d camera_odom_m = Eigen::Vector2d::Zero();  ///< from odometry at the stamp, seen from above
    double azimuth_rad = 0.0;                                 ///< direction of the window, odom axes
    double yaw_rate_radps = 0.0;                              ///< by odometry at the stamp
  };
  struct Offset {
    double late_sec = 0.0;  ///< stamps of images relative to those of odometry; negative: early
    double sigma_sec = 0.0;
    /// True if it indicates a wrong clock or driver.
    bool isTooLarge() const;
  };

  /// Ignores values that are not finite. A stamp that is not later than the last one starts a new stretch.
  /// \param window_odom_m estimated position of the window, seen from above
  void see(const Sight& sight, const Eigen::Vector2d& window_odom_m);
  /// The odometry frame or the window changed; the offset found so far stays.
  void forgetPlaces() { stretch_.clear(); }
  void clear() { *this = ClockCheck(); }

  /// Nothing before the first turn.
  const std::optional<Offset>& offset() const { return offset_; }

 private:
  std::optional<Offset> slopeWith(const Eigen::Vector2d& window_odom_m) const;
  void join(const Offset& found);

  std::deque<Sight> stretch_;
  std::optional<Offset> offset_;
};

}  // namespace window_ingress::estimation
