#include "evaluation/flights/flight_perception.hpp"

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::evaluation {

FlightPerception::FlightPerception(const configuration::Overlay& nodes)
    : perception_(nodes.window_detector.detector, nodes.window_detector.interior),
      estimator_(nodes.homography_pose.pose, nodes.homography_pose.filter, nodes.homography_pose.tracker) {}

void FlightPerception::calibrate(const std::optional<geometry::PinholeCamera>& camera) {
  camera_ = camera && camera->validate().empty() ? camera : std::nullopt;
}

double FlightPerception::addOdometry(const navigation::VehicleState& vehicle, double arrival_sec) {
  const double stamp_sec = odometry_clock_.atReceiver(vehicle.stamp_sec, arrival_sec);
  estimator_.addOdometry(stamp_sec, vehicle.T_odom_base, vehicle.velocity_odom_mps, vehicle.turn_odom_radps);
  return stamp_sec;
}

void FlightPerception::addAttitude(double stamp_sec, const Eigen::Quaterniond& R_odom_base) {
  estimator_.addAttitude(stamp_sec, R_odom_base);
  attitude_.add(stamp_sec, geometry::makePose(R_odom_base.toRotationMatrix(), Eigen::Vector3d::Zero()));
}

// The expected place of the target is computed with the pose of one image and used for the next one.
const std::optional<detection::WindowObservation>& FlightPerception::detect(
    const cv::Mat& image, double stamp_sec, const std::optional<Eigen::Isometry3d>& T_base_camera) {
  detection::TrackInput seen;
  seen.image = image;
  seen.stamp_sec = stamp_sec;
  seen.camera = camera_ ? &*camera_ : nullptr;
  const auto T_odom_base = attitude_.at(stamp_sec, kMaxAttitudeGapSec);
  if (T_base_camera && T_odom_base) seen.R_world_camera = T_odom_base->linear() * T_base_camera->linear();
  if (T_base_camera && camera_ && last_seen_sec_ &&
      stamp_sec - *last_seen_sec_ <= perception::kExpectationLastsSec)
    seen.expected = estimator_.expected(*last_seen_sec_, *camera_, *T_base_camera);
  return perception_.update(seen);
}

void FlightPerception::addDetection(double stamp_sec, const std::optional<Eigen::Isometry3d>& T_base_camera,
                                    const std::optional<detection::WindowObservation>& window) {
  if (!camera_) return last_seen_sec_.reset();
  estimator_.addDetection({stamp_sec, *camera_, T_base_camera, window, perception_.windows()});
  last_seen_sec_ = stamp_sec;
}

void FlightPerception::forget() {
  perception_.reset();
  attitude_.clear();
  odometry_clock_.clear();
  estimator_.reset();
  last_seen_sec_.reset();
}

}  // namespace window_ingress::evaluation
