/// Messages to the types of the core and back: free functions, one direction each. What comes from outside is
/// either converted whole or refused with a reason; nothing that is not finite gets in or out.
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
#include <optional>
#include <string>
#include <vector>

#include "window_ingress/configuration/common_params.hpp"
#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/seen_windows.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/frames_verdict.hpp"
#include "window_ingress/estimation/size_estimate.hpp"
#include "window_ingress/estimation/window_filter.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/facade/facade_memory.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/navigation/navigator.hpp"
#include "window_ingress/openness/openness_verdict.hpp"

namespace window_ingress::adapters {

using configuration::FrameNames;

/// A converted message, or why it cannot be used.
template <typename Value>
struct Converted {
  std::optional<Value> value;
  std::string reason;  ///< empty if there is a value
  explicit operator bool() const { return value.has_value(); }
};

// --- geometry

/// Normalises; refuses what is not finite or further than 1 % from unit length.
Converted<Eigen::Quaterniond> fromMsg(const geometry_msgs::Quaternion& message);
Converted<Eigen::Isometry3d> fromMsg(const geometry_msgs::Pose& message);
Converted<Eigen::Isometry3d> fromMsg(const geometry_msgs::Transform& message);

geometry_msgs::Pose toPoseMsg(const Eigen::Isometry3d& pose);
geometry_msgs::PoseWithCovariance toMsg(const Eigen::Isometry3d& pose,
                                        const estimation::Matrix6d& covariance);
geometry_msgs::Vector3 toVectorMsg(const Eigen::Vector3d& vector);
Eigen::Vector3d toEigen(const geometry_msgs::Vector3& vector);

std_msgs::Header headerOf(const ros::Time& stamp, const std::string& frame_id);

geometry_msgs::TransformStamped toTransformStampedMsg(const Eigen::Isometry3d& pose,
                                                      const std_msgs::Header& header,
                                                      const std::string& child);

/// base_link -> camera_link (forward-left-up) -> `camera_frame` (right-down-forward), REP 103.
std::vector<geometry_msgs::TransformStamped> mountingOf(const Eigen::Isometry3d& T_base_camera,
                                                        const ros::Time& stamp, const FrameNames& frames,
                                                        const std::string& camera_frame);

// --- sensors

/// \param rectified the images are rectified: P is used instead of K and D
/// Binning and region of interest are applied: the camera is that of the image as it comes (REP 104).
Converted<geometry::PinholeCamera> cameraFromMsg(const sensor_msgs::CameraInfo& message, bool rectified);
sensor_msgs::CameraInfo toMsg(const geometry::PinholeCamera& camera);  ///< without header

/// The twist is taken in the child frame, as REP 147 and nav_msgs say, and rotated to odom.
Converted<navigation::VehicleState> fromMsg(const nav_msgs::Odometry& message, const FrameNames& frames);

/// Attitude of the vehicle.
struct StampedAttitude {
  double stamp_sec = 0.0;
  Eigen::Quaterniond R_odom_base = Eigen::Quaterniond::Identity();
};
/// Refused in another frame, and where the message says that it has no attitude (REP 145).
Converted<StampedAttitude> fromMsg(const sensor_msgs::Imu& message, const std::string& base_frame);

// --- window

// Messages without header, and of detections without what the image was.
window_ingress::WindowDetection toMsg(const detection::WindowObservation& window);
window_ingress::WindowDetection toMsg(const detection::DetectionTrace& trace);  ///< why there is no window
/// Refuses `detected == false` with the message's own reason.
Converted<detection::WindowObservation> fromMsg(const window_ingress::WindowDetection& message);
window_ingress::InteriorPoints toMsg(const detection::InteriorTracks& interior);
/// None if the lists are not of one length or there is no key image.
detection::InteriorTracks fromMsg(const window_ingress::InteriorPoints& message);
window_ingress::DetectedWindow toMsg(const detection::SeenWindow& window);
/// Those of the message that are convex, finite quadrilaterals; at most `kMaxSeenWindows`.
std::vector<detection::SeenWindow> seenWindowsFrom(const window_ingress::WindowDetection& message);
constexpr std::size_t kMaxSeenWindows = 64;
window_ingress::Facade toMsg(const facade::FacadeMemory& memory, double now_sec);

/// What the pose node has verified on the way.
struct VerifiedTarget {
  estimation::FramesVerdict frames;
  estimation::FitVerdict fit{estimation::Fit::kUnknown, ""};
  estimation::Consistency consistency;
  std::optional<double> other_window;
  std::string approach_forbidden, unverified;
};

window_ingress::ImagePose toMsg(const estimation::PoseResult& result);
/// \return that the image contributed; the frame is left to the caller
window_ingress::FilteredPose toMsg(const estimation::FilteredWindow& filtered);
window_ingress::WindowSize toMsg(const geometry::OpeningSize& size);  ///< as told: without deviation
window_ingress::WindowSize toMsg(const estimation::SizeEstimate& estimate);
window_ingress::SystemChecks toMsg(const VerifiedTarget& verified);
window_ingress::Openness toMsg(const openness::OpennessVerdict& verdict);
openness::OpennessVerdict fromMsg(const window_ingress::Openness& message);  ///< what is no verdict is none
window_ingress::CameraInBody toMsg(const navigation::CameraInBody& camera);
/// Nothing where the message does not know, or says why no image can give a pose. Its numbers are judged by
/// the navigator.
std::optional<navigation::CameraInBody> cameraFromMsg(const window_ingress::CameraInBody& message);
/// \param target null: not known to be the target yet
/// \param expected where it must be in the image
window_ingress::RememberedTarget targetMsg(const facade::KnownWindow* target,
                                           const std::optional<geometry::Quadrilateral>& expected);
std::optional<geometry::Quadrilateral> expectedFrom(const window_ingress::RememberedTarget& message);
Converted<navigation::TargetEstimate> targetFromMsg(const window_ingress::WindowPose& message,
                                                    const std::string& odom_frame);

/// Where the target is by the memory of all windows.
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
