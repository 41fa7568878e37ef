#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "simulation/camera/camera_truth.hpp"
#include "simulation/random_stream.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::evaluation {

/// Path and motion of a camera towards the window.
struct FlightRange {
  double nearest_start_m = 4.0, farthest_start_m = 7.0;  ///< distance of the start from the opening [m]
  double off_axis_rad = 0.5;  ///< largest angle of the start to either side of the opening's normal [rad]
  double end_m = 0.4;         ///< end of the flight in front of the opening's plane [m]
  double speed_mps = 1.5;     ///< towards the plane [m/s]
  double wobble_rad = 0.06;   ///< amplitude of roll, pitch and heading about the path [rad]
};

/// A flight towards the opening's middle, drawn from the seed: from the start it curves onto the axis, looks
/// at the opening and wobbles about all axes, each at its own frequency between 0.4 and 1.2 Hz. Continuous
/// and smooth.
class SurveyFlight {
 public:
  SurveyFlight(const FlightRange& range, std::uint32_t seed) : range_(range) {
    simulation::RandomStream random(seed, "survey flight");
    const double distance_m = random.uniform(range.nearest_start_m, range.farthest_start_m);
    const double bearing_rad = random.uniform(-range.off_axis_rad, range.off_axis_rad);
    start_ = {-distance_m * std::cos(bearing_rad), distance_m * std::sin(bearing_rad),
              random.uniform(-kHeight_m, kHeight_m)};
    for (int i = 0; i < 5; ++i) {
      const double amplitude = i < 3 ? range.wobble_rad : kSway_m;
      const double rate_radps = 2.0 * M_PI * random.uniform(0.4, 1.2);
      wobbles_.push_back({amplitude, rate_radps, random.uniform(0.0, 2.0 * M_PI)});
    }
  }

  /// Time until the end in front of the plane.
  double durationSec() const { return (-start_.x() - range_.end_m) / range_.speed_mps; }
  Eigen::Isometry3d T_window_camera(double time_sec) const {
    const double left = 1.0 - time_sec / durationSec();
    const double bend = left * left;
    const Eigen::Vector3d eye(start_.x() + range_.speed_mps * time_sec,
                              start_.y() * bend + wobbles_[3].at(time_sec),
                              start_.z() * bend + wobbles_[4].at(time_sec));
    const Eigen::Vector3d way = Eigen::Vector3d(kLooksAhead_m, 0.0, 0.0) - eye;
    const double heading_rad = std::atan2(way.y(), way.x()) + wobbles_[2].at(time_sec);
    const double pitch_rad = -std::atan2(way.z(), way.head<2>().norm()) + wobbles_[1].at(time_sec);
    const Eigen::Matrix3d look =
        geometry::yawRotation(heading_rad) *
        Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()).toRotationMatrix() *
        Eigen::AngleAxisd(wobbles_[0].at(time_sec), Eigen::Vector3d::UnitX()).toRotationMatrix();
    return geometry::makePose(look * geometry::R_optical_flu().transpose(), eye);
  }

  /// Velocities by central differences.
  simulation::CameraTruth motion(double time_sec) const {
    const Eigen::Isometry3d before = T_window_camera(time_sec - kDifference_sec);
    const Eigen::Isometry3d after = T_window_camera(time_sec + kDifference_sec);
    simulation::CameraTruth motion;
    motion.T_window_camera = T_window_camera(time_sec);
    motion.velocity_window_mps = (after.translation() - before.translation()) / (2.0 * kDifference_sec);
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(before.linear().transpose() * after.linear()));
    motion.angular_velocity_camera_radps = turn.angle() / (2.0 * kDifference_sec) * turn.axis();
    return motion;
  }

 private:
  static constexpr double kSway_m = 0.05, kHeight_m = 0.4;
  static constexpr double kDifference_sec = 1e-4;
  static constexpr double kLooksAhead_m =
      1.5;  // behind the plane, so that the camera does not turn fast near it

  struct Wobble {
    double amplitude, rate_radps, phase_rad;
    double at(double time_sec) const { return amplitude * std::sin(rate_radps * time_sec + phase_rad); }
  };

  FlightRange range_;
  Eigen::Vector3d start_;
  std::vector<Wobble> wobbles_;  ///< of roll, pitch, heading [rad], and of y and z [m]
};

}  // namespace window_ingress::evaluation
