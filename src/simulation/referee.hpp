#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "simulation/scene/obstacle_collision.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::simulation {

/// How a flight ended. FALSE_INGRESS: the vehicle claims to have passed and has not.
enum class Outcome { kRunning, kPassed, kCollision, kFalseIngress, kAborted, kTimeout };

const char* toString(Outcome outcome);

/// What the vehicle says about itself.
enum class Claim { kNone, kPassed, kAborted };

/// What the referee knows about the world.
struct Course {
  Eigen::Isometry3d T_odom_window = Eigen::Isometry3d::Identity();
  geometry::OpeningSize opening;
  double wall_thickness_m = 0.0;  ///< the opening reaches from x = 0 to here
  Eigen::Vector3d vehicle_half_extents_m = Eigen::Vector3d::Zero();
  std::vector<Obstacle> obstacles;
  double time_limit_sec = 60.0;
  double ground_z_m = -1e9;  ///< of the ground in the window frame; a start from it is no contact
};

/// Where the vehicle's centre went through the plane of the window, from outside to inside.
struct Crossing {
  double time_sec = 0.0;
  double offset_y_m = 0.0;  ///< from the opening's centre, left
  double offset_z_m = 0.0;  ///< up
  bool inside = false;      ///< within the opening less the vehicle's half extents
};

struct Verdict {
  Outcome outcome = Outcome::kRunning;
  std::string reason;  ///< for people, with numbers
};

/// Judges a flight by the truth alone.
///
/// PASSED: the crossing of the plane (the last one, should the vehicle have come out again) lies inside the
/// opening less the vehicle's half extents (of its box as turned at that moment), nothing was ever touched,
/// and the vehicle stood (< `kStandingSpeed_mps` for `kStandingTime_sec`) with its whole box behind the wall.
/// What the vehicle claims cannot make a flight PASSED.
class Referee {
 public:
  static constexpr double kStandingSpeed_mps = 0.1;
  static constexpr double kStandingTime_sec = 0.5;

  explicit Referee(const Course& course);

  /// To be called for each physics step, times not decreasing.
  void update(double time_sec, const VehicleTruth& truth);

  /// COLLISION before all else; then PASSED; then what the claim makes of the flight; then TIMEOUT. A claim
  /// of having passed after a true crossing is still RUNNING until the vehicle stands. The time limit runs
  /// from `mission_start_sec`.
  Verdict judge(Claim claim, double mission_start_sec = 0.0) const;

  const std::optional<Crossing>& crossing() const { return crossing_; }
  bool touched() const { return !contact_.empty(); }
  /// Smallest gap between the vehicle's box and the borders of the opening while the box was between them,
  /// negative if it cut into them; nothing if it never was [m].
  std::optional<double> minClearance() const { return min_clearance_m_; }
  /// While outside: the largest |y| in the window frame beyond that of the start, 0 if there was none. An
  /// overshoot past the axis counts once it reaches further than the start was [m].
  double wrongSide() const { return wrong_side_m_; }
  /// Smallest gap to anything but the ground since it took off, of the boxes about both along the window's
  /// axes: never more than the true gap [m].
  double nearest() const { return nearest_m_; }
  double maxSpeed() const { return max_speed_mps_; }  ///< [m/s]

 private:
  struct Sample {
    double time_sec = 0.0;
    Eigen::Isometry3d T_window_base = Eigen::Isometry3d::Identity();
    Eigen::Vector3d reach_m = Eigen::Vector3d::Zero();  // of the turned box along the window's axes
  };
  void watchContacts(const Sample& now);
  void watchNearest(const Sample& now);
  void watchCrossing(const Sample& now);
  void watchClearance(const Sample& now);
  void watchSides(const Sample& now);
  void watchStanding(const Sample& now, double speed_mps);
  void touch(const std::string& name, double time_sec);

  Course course_;
  std::optional<Sample> previous_;
  std::optional<Crossing> crossing_;
  std::optional<double> min_clearance_m_, start_y_m_, standing_since_sec_;
  std::string contact_;
  double nearest_m_ = 1e3;
  bool airborne_ = false, stood_behind_ = false;
  double contact_time_sec_ = 0.0, wrong_side_m_ = 0.0, max_speed_mps_ = 0.0, time_sec_ = 0.0;
};

}  // namespace window_ingress::simulation
