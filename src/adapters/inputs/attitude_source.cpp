#include "adapters/inputs/attitude_source.hpp"

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/conversions/stamps.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kMaxGapSec = 0.02;  // small, because a turn is measured by the difference of two attitudes

}  // namespace

TfAttitude::TfAttitude(const tf2_ros::Buffer& tf, const std::string& odom_frame,
                       const std::string& base_frame)
    : tf_(tf),
      odom_frame_(odom_frame),
      base_frame_(base_frame),
      known_sec_(steadyNowSec()),
      asked_sec_(known_sec_ - 2.0 * kSilenceSec) {}

std::optional<Eigen::Quaterniond> TfAttitude::at(double stamp_sec) {
  asked_sec_ = steadyNowSec();
  try {
    const auto found = tf_.lookupTransform(odom_frame_, base_frame_, toStamp(stamp_sec));
    const auto rotation = fromMsg(found.transform.rotation);
    fault_ = rotation.reason;
    if (rotation) known_sec_ = asked_sec_;
    return rotation.value;
  } catch (const tf2::TransformException& error) {
    fault_ = error.what();
    return std::nullopt;
  }
}

Health TfAttitude::health() const {
  const double now_sec = steadyNowSec();
  const bool asked = now_sec - asked_sec_<kSilenceSec, lasts = now_sec - known_sec_> kSilenceSec;
  if (fault_.empty() || !asked || !lasts) return {};
  return {Health::kError, "no attitude: " + odom_frame_ + " <- " + base_frame_ +
                              " is not in tf at the time of the image: " + fault_};
}

Converted<Eigen::Isometry3d> mountingOf(const tf2_ros::Buffer& tf, const std::string& base_frame,
                                        const std::string& camera_frame) {
  const std::string which = "camera mounting " + base_frame + " <- '" + camera_frame + "': ";
  if (camera_frame.empty()) return {std::nullopt, which + "the image has no frame_id"};
  try {
    const auto pose = fromMsg(tf.lookupTransform(base_frame, camera_frame, ros::Time(0)).transform);
    return pose ? pose : Converted<Eigen::Isometry3d>{std::nullopt, which + pose.reason};
  } catch (const tf2::TransformException& error) {
    return {std::nullopt, which + "not in tf: " + error.what()};
  }
}

AttitudeSource::AttitudeSource(ros::NodeHandle& nh, Diagnostics& diagnostics, const std::string& base_frame,
                               int queue)
    : base_frame_(base_frame), tf_listener_(tf_) {
  subscriber_ = subscribeCatching<sensor_msgs::Imu>(nh, "imu", queue, diagnostics,
                                                    [this](const auto& message) { receive(*message); });
  diagnostics.add("attitude", [this] { return health(); });
}

void AttitudeSource::receive(const sensor_msgs::Imu& message) {
  const auto attitude = fromMsg(message, base_frame_);
  refusal_ = attitude.reason;
  if (attitude)
    attitudes_.add(
        attitude.value->stamp_sec,
        geometry::makePose(attitude.value->R_odom_base.toRotationMatrix(), Eigen::Vector3d::Zero()));
  stamp_ = message.header.stamp;
  if (came_) came_();
}

std::optional<Eigen::Matrix3d> AttitudeSource::R_world_camera(double stamp_sec,
                                                              const std::string& camera_frame) {
  missing_ = refusal_;
  const auto T_world_base = attitudes_.at(stamp_sec, kMaxGapSec);
  if (!T_world_base && missing_.empty())
    missing_ = "nothing on " + subscriber_.getTopic() + " near the exposure";
  if (!T_world_base) return std::nullopt;
  const auto T_base_camera = mountingOf(tf_, base_frame_, camera_frame);
  missing_ = T_base_camera.reason;
  if (!T_base_camera) return std::nullopt;
  return T_world_base->linear() * T_base_camera.value->linear();
}

bool AttitudeSource::isConnected(const std::string& camera_frame) const {
  return subscriber_.getNumPublishers() > 0 && mountingOf(tf_, base_frame_, camera_frame);
}

Health AttitudeSource::health() const {
  if (missing_.empty()) return {Health::kOk, "known at the last image"};
  return {Health::kOk, "not known at the last image; tracking uses the image alone: " + missing_};
}

}  // namespace window_ingress::adapters
