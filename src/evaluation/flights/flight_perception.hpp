#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/estimation/pose_buffer.hpp"
#include "window_ingress/estimation/sender_clock.hpp"
#include "window_ingress/estimation/target_estimator.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/navigation/navigation_types.hpp"
#include "window_ingress/perception/window_perception.hpp"

namespace window_ingress::evaluation {

/// Perception of a flight in one process, or of a recorded one: detector, pose and filter connected as the
/// nodes are. Processes inputs in the order of arrival.
class FlightPerception {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit FlightPerception(const configuration::Overlay& nodes)
      : perception_(nodes.window_detector.detector, nodes.window_detector.interior),
        estimator_(nodes.homography_pose.pose, nodes.homography_pose.filter, nodes.homography_pose.tracker) {}

  void setReference(const detection::ReferenceAppearance& reference) { perception_.setReference(reference); }
  /// No calibration, or an unusable one, removes the previous one.
  void calibrate(const std::optional<geometry::PinholeCamera>& camera) {
    camera_ = camera && camera->validate().empty() ? camera : std::nullopt;
  }
  /// \return its stamp in the receiver's clock
  double addOdometry(const navigation::VehicleState& vehicle, double arrival_sec) {
    const double stamp_sec = odometry_clock_.atReceiver(vehicle.stamp_sec, arrival_sec);
    estimator_.addOdometry(stamp_sec, vehicle.T_odom_base, vehicle.velocity_odom_mps,
                           vehicle.turn_odom_radps);
    return stamp_sec;
  }
  void addAttitude(double stamp_sec, const Eigen::Quaterniond& R_odom_base) {
    estimator_.addAttitude(stamp_sec, R_odom_base);
    attitude_.add(stamp_sec, geometry::makePose(R_odom_base.toRotationMatrix(), Eigen::Vector3d::Zero()));
  }
  bool knowsAttitude(double stamp_sec) const {
    return attitude_.at(stamp_sec, kMaxAttitudeGapSec).has_value();
  }

  /// Result of the detector for an image.
  // The expected place of the target is computed with the pose of one image and used for the next one.
  const std::optional<detection::WindowObservation>& detect(
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
  /// Passes an observation, from the detector or elsewhere, on to the target; only with a calibration.
  void addDetection(double stamp_sec, const std::optional<Eigen::Isometry3d>& T_base_camera,
                    const std::optional<detection::WindowObservation>& window) {
    if (!camera_) return last_seen_sec_.reset();
    estimator_.addDetection({stamp_sec, *camera_, T_base_camera, window, perception_.windows()});
    last_seen_sec_ = stamp_sec;
  }
  /// Forgets all but parameters and reference.
  void forget() {
    perception_.reset();
    attitude_.clear();
    odometry_clock_.clear();
    estimator_.reset();
    last_seen_sec_.reset();
  }

  const perception::WindowPerception& perception() const { return perception_; }
  const std::optional<geometry::PinholeCamera>& camera() const { return camera_; }
  estimation::TargetEstimator& estimator() { return estimator_; }
  const estimation::TargetEstimator& estimator() const { return estimator_; }

 private:
  static constexpr double kMaxAttitudeGapSec = 0.02;

  perception::WindowPerception perception_;
  estimation::PoseBuffer attitude_;
  estimation::SenderClock odometry_clock_;
  estimation::TargetEstimator estimator_;
  std::optional<geometry::PinholeCamera> camera_;  // from the last camera_info
  std::optional<double> last_seen_sec_;
};

}  // namespace window_ingress::evaluation
