#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

namespace window_ingress::estimation {

/// By how much the stamps of images and those of odometry differ. While a vehicle turns at w, odometry at a
/// stamp that is late by d has turned on by w d: the direction in which a window that stands still is seen
/// moves by as much. The slope of that over the rate is d. It needs a turn that begins or ends while the
/// window is seen whole, as after every search.
class ClockCheck {
 public:
  /// One image of the window, whole.
  struct Sight {
    double stamp_sec = 0.0;
    Eigen::Vector2d camera_odom_m = Eigen::Vector2d::Zero();  ///< by odometry at the stamp, seen from above
    double azimuth_rad = 0.0;                                 ///< in which the window is seen, odom axes
    double yaw_rate_radps = 0.0;                              ///< by odometry at the stamp
  };
  struct Offset {
    double late_sec = 0.0;  ///< stamps of images beside those of odometry; negative: early
    double sigma_sec = 0.0;
    /// Somebody's clock or driver is wrong by it.
    bool isTooLarge() const;
  };

  /// Not finite: ignored; a stamp that is not later than the last one starts a new stretch.
  /// \param window_odom_m where it is believed to be, seen from above
  void see(const Sight& sight, const Eigen::Vector2d& window_odom_m);
  /// Odometry's frame or the window is another one; what was found out stays.
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
