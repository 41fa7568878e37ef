/// Converts messages to the types of the core and back: free functions, one direction each. A message is
/// either converted completely or refused with a reason. Numbers that are not finite pass in neither
/// direction.
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseWithCovariance.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Imu.h>
#include <window_ingress/Facade.h>
#include <window_ingress/IngressState.h>
#include <window_ingress/WindowDetection.h>
#include <window_ingress/WindowPose.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/seen_windows.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/size_estimate.hpp"
#include "window_ingress/estimation/target_estimate.hpp"
#include "window_ingress/estimation/window_filter.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/facade/facade_memory.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/navigation/navigator.hpp"
#include "window_ingress/navigation/vehicle_params.hpp"
#include "window_ingress/openness/openness_verdict.hpp"

namespace window_ingress::adapters {

using navigation::FrameNames;

/// A converted message, or why it cannot be used.
template <typename Value>
struct Converted {
  std::optional<Value> value;
  std::string reason;  ///< why there is no value; empty if there is one
  explicit operator bool() const { return value.has_value(); }
};

// --- time: stamps are compared as doubles, because the difference of two `ros::Time` throws beyond 2^31 s

/// Seconds of a stamp; empty if it is zero (unstamped) or its nanoseconds are not below 1e9.
inline std::optional<double> stampSec(const ros::Time& stamp) {
  if (stamp.isZero() || stamp.nsec >= 1000000000u) return std::nullopt;
  return stamp.toSec();
}

/// The nearest stamp for a time in seconds; zero if no stamp can hold it.
inline ros::Time toStamp(double sec) {
  constexpr double kEnd = std::numeric_limits<std::uint32_t>::max();
  return sec >= 0.0 && sec < kEnd ? ros::Time(sec) : ros::Time();
}

// --- geometry

/// Normalises. Refuses quaternions that are not finite or differ by more than 1 % from unit length.
Converted<Eigen::Quaterniond> fromMsg(const geometry_msgs::Quaternion& message);
Converted<Eigen::Isometry3d> fromMsg(const geometry_msgs::Pose& message);
Converted<Eigen::Isometry3d> fromMsg(const geometry_msgs::Transform& message);

geometry_msgs::Pose toPoseMsg(const Eigen::Isometry3d& pose);
geometry_msgs::PoseWithCovariance toMsg(const Eigen::Isometry3d& pose,
                                        const estimation::Matrix6d& covariance);
geometry_msgs::Vector3 toVectorMsg(const Eigen::Vector3d& vector);
/// \param xyz a vector or a point
template <typename Xyz>
Eigen::Vector3d toEigen(const Xyz& xyz) {
  return {xyz.x, xyz.y, xyz.z};
}

std_msgs::Header headerOf(const ros::Time& stamp, const std::string& frame_id);

geometry_msgs::TransformStamped toTransformStampedMsg(const Eigen::Isometry3d& pose,
                                                      const std_msgs::Header& header,
                                                      const std::string& child);

/// base_link -> camera_link (forward-left-up) -> `camera_frame` (right-down-forward), REP 103.
std::vector<geometry_msgs::TransformStamped> mountingOf(const Eigen::Isometry3d& T_base_camera,
                                                        const ros::Time& stamp, const FrameNames& frames,
                                                        const std::string& camera_frame);

// --- sensors

/// Applies binning and region of interest: the camera is that of the received image (REP 104).
/// \param rectified the images are rectified: P is used instead of K and D
Converted<geometry::PinholeCamera> cameraFromMsg(const sensor_msgs::CameraInfo& message, bool rectified);
/// Why the calibration on this topic is not that of an image of this size; empty if it may be. An empty
/// `frame_id` of the image matches every frame.
std::string misfitOf(const geometry::PinholeCamera& camera, const std::string& camera_frame_id,
                     const std::string& topic, int width_px, int height_px, const std::string& frame_id);
sensor_msgs::CameraInfo toMsg(const geometry::PinholeCamera& camera);  ///< without header

/// Takes the twist in the child frame (REP 147, nav_msgs) and rotates it to odom.
Converted<navigation::VehicleState> fromMsg(const nav_msgs::Odometry& message, const FrameNames& frames);

/// Attitude of the vehicle.
struct StampedAttitude {
  double stamp_sec = 0.0;
  Eigen::Quaterniond R_odom_base = Eigen::Quaterniond::Identity();
};
/// Refuses another frame, and messages marked as having no attitude (REP 145).
Converted<StampedAttitude> fromMsg(const sensor_msgs::Imu& message, const std::string& base_frame);

// --- window

// Messages have no header; detections do not describe their image.
window_ingress::WindowDetection toMsg(const detection::WindowObservation& window);
window_ingress::WindowDetection toMsg(const detection::DetectionTrace& trace);  ///< no window, with reason
/// Refuses `detected == false` with the message's reason.
Converted<detection::WindowObservation> fromMsg(const window_ingress::WindowDetection& message);
window_ingress::InteriorPoints toMsg(const detection::InteriorTracks& interior);
/// Empty if the lists differ in length or there is no keyframe.
detection::InteriorTracks fromMsg(const window_ingress::InteriorPoints& message);
window_ingress::DetectedWindow toMsg(const detection::SeenWindow& window);
/// The convex, finite quadrilaterals of the message, at most `kMaxSeenWindows`.
std::vector<detection::SeenWindow> seenWindowsFrom(const window_ingress::WindowDetection& message);
constexpr std::size_t kMaxSeenWindows = 64;
window_ingress::Facade toMsg(const facade::FacadeMemory& memory, double now_sec);

/// Checks by the pose node.
struct VerifiedTarget {
  estimation::FramesVerdict frames;
  estimation::FitVerdict fit{estimation::Fit::kUnknown, ""};
  estimation::Consistency consistency;
  std::optional<double> other_window;
  std::string approach_forbidden, unverified;
};

window_ingress::ImagePose toMsg(const estimation::PoseResult& result);
/// \return a message of an image that contributed, without frame
window_ingress::FilteredPose toMsg(const estimation::FilteredWindow& filtered);
window_ingress::WindowSize toMsg(const geometry::OpeningSize& size);  ///< as given, without deviation
window_ingress::WindowSize toMsg(const estimation::SizeEstimate& estimate);
window_ingress::SystemChecks toMsg(const VerifiedTarget& verified);
window_ingress::Openness toMsg(const openness::OpennessVerdict& verdict);
openness::OpennessVerdict fromMsg(const window_ingress::Openness& message);  ///< UNKNOWN if invalid
window_ingress::CameraInBody toMsg(const navigation::CameraInBody& camera);
/// Empty if the camera is unknown or no image can give a pose. The navigator checks the numbers.
std::optional<navigation::CameraInBody> cameraFromMsg(const window_ingress::CameraInBody& message);
/// \param target null if the target is not known yet
/// \param expected the target's expected place in the image
window_ingress::RememberedTarget targetMsg(const facade::KnownWindow* target,
                                           const std::optional<geometry::Quadrilateral>& expected);
std::optional<geometry::Quadrilateral> expectedFrom(const window_ingress::RememberedTarget& message);
Converted<navigation::TargetEstimate> targetFromMsg(const window_ingress::WindowPose& message,
                                                    const std::string& odom_frame);

/// The remembered place of the target, in odom.
std::optional<Eigen::Vector3d> rememberedFrom(const window_ingress::WindowPose& message,
                                              const std::string& odom_frame);

// --- flight

/// In odom axes, or rotated into `base_link` by `R_odom_base`; `header.frame_id` says which.
geometry_msgs::TwistStamped toTwistMsg(const navigation::Setpoint& setpoint, const FrameNames& frames,
                                       const std::optional<Eigen::Matrix3d>& R_odom_base);
Converted<navigation::Setpoint> fromMsg(const geometry_msgs::TwistStamped& message, const FrameNames& frames,
                                        const Eigen::Matrix3d& R_odom_base);

window_ingress::IngressState toMsg(const navigation::NavigatorOutput& output);  ///< without header

}  // namespace window_ingress::adapters
