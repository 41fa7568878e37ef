#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "simulation/scene/obstacle_collision.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::simulation {

/// How a flight ended. FALSE_INGRESS: the vehicle claims to have passed, but has not.
enum class Outcome { kRunning, kPassed, kCollision, kFalseIngress, kAborted, kTimeout };

const char* toString(Outcome outcome);

/// The vehicle's claim about its own flight.
enum class Claim { kNone, kPassed, kAborted };

/// The world as the referee knows it.
struct Course {
  Eigen::Isometry3d T_odom_window = Eigen::Isometry3d::Identity();
  geometry::OpeningSize opening;
  double wall_thickness_m = 0.0;  ///< the opening extends from x = 0 to this x
  Eigen::Vector3d vehicle_half_extents_m = Eigen::Vector3d::Zero();
  std::vector<Obstacle> obstacles;
  double time_limit_sec = 60.0;
  double ground_z_m = -1e9;  ///< ground in the window frame; a start from the ground is no contact
};

/// Where the vehicle's centre crossed the plane of the window from outside to inside.
struct Crossing {
  double time_sec = 0.0;
  double offset_y_m = 0.0;  ///< from the opening's centre, left
  double offset_z_m = 0.0;  ///< up
  bool inside = false;      ///< within the opening reduced by the vehicle's half extents
};

struct Verdict {
  Outcome outcome = Outcome::kRunning;
  std::string reason;  ///< text with numbers
};

/// Judges a flight by the truth alone.
///
/// PASSED requires: the last crossing of the plane lies inside the opening, reduced by the half extents of
/// the vehicle's box as turned at that moment; the vehicle never touched anything; and it stood with its
/// whole box behind the wall (below `kStandingSpeed_mps` for `kStandingTime_sec`). Its claim cannot make a
/// flight PASSED.
class Referee {
 public:
  static constexpr double kStandingSpeed_mps = 0.1;
  static constexpr double kStandingTime_sec = 0.5;

  explicit Referee(const Course& course);

  /// Call for each physics step; times must not decrease.
  void update(double time_sec, const VehicleTruth& truth);

  /// The first that applies: COLLISION, PASSED, the outcome of the claim, TIMEOUT. A claim of having passed
  /// after a true crossing is still RUNNING until the vehicle stands. The time limit runs from
  /// `mission_start_sec`.
  Verdict judge(Claim claim, double mission_start_sec = 0.0) const;

  const std::optional<Crossing>& crossing() const { return crossing_; }
  bool touched() const { return !contact_.empty(); }
  /// Smallest gap [m] between the vehicle's box and the opening's borders while the box was between them;
  /// negative if the box cut into them; empty if the box never was there.
  std::optional<double> minClearance() const { return min_clearance_m_; }
  /// Largest |y| in the window frame beyond the start's |y| while outside [m]; 0 if there was none. An
  /// overshoot past the axis counts once it reaches further than the start.
  double wrongSide() const { return wrong_side_m_; }
  /// Smallest gap [m] since take-off to anything but the ground. Uses bounding boxes along the window's axes,
  /// so the result is never more than the true gap.
  double nearest() const { return nearest_m_; }
  double maxSpeed() const { return max_speed_mps_; }  ///< [m/s]

 private:
  struct Sample {
    double time_sec = 0.0;
    Eigen::Isometry3d T_window_base = Eigen::Isometry3d::Identity();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d reach_m = Eigen::Vector3d::Zero();  // of the turned box, along the window's axes
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
