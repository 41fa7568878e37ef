#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/estimation/pose_buffer.hpp"
#include "window_ingress/estimation/sender_clock.hpp"
#include "window_ingress/estimation/target_estimator.hpp"
#include "window_ingress/navigation/navigation_types.hpp"
#include "window_ingress/perception/window_perception.hpp"

namespace window_ingress::evaluation {

/// Perception of a flight in one process, or of a recorded one: detector, pose and filter connected as the
/// nodes are. Processes inputs in the order of arrival.
class FlightPerception {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit FlightPerception(const configuration::Overlay& nodes);

  void setReference(const detection::ReferenceAppearance& reference) { perception_.setReference(reference); }
  /// No calibration, or an unusable one, removes the previous one.
  void calibrate(const std::optional<geometry::PinholeCamera>& camera);
  /// \return its stamp in the receiver's clock
  double addOdometry(const navigation::VehicleState& vehicle, double arrival_sec);
  void addAttitude(double stamp_sec, const Eigen::Quaterniond& R_odom_base);
  bool knowsAttitude(double stamp_sec) const {
    return attitude_.at(stamp_sec, kMaxAttitudeGapSec).has_value();
  }

  /// Result of the detector for an image.
  const std::optional<detection::WindowObservation>& detect(
      const cv::Mat& image, double stamp_sec, const std::optional<Eigen::Isometry3d>& T_base_camera);
  /// Passes an observation, from the detector or elsewhere, on to the target; only with a calibration.
  void addDetection(double stamp_sec, const std::optional<Eigen::Isometry3d>& T_base_camera,
                    const std::optional<detection::WindowObservation>& window);
  /// Forgets all but parameters and reference.
  void forget();

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
