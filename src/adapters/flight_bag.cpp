#include "adapters/flight_bag.hpp"

#include <sensor_msgs/CompressedImage.h>
#include <tf2_msgs/TFMessage.h>

#include <opencv2/imgcodecs.hpp>

#include "adapters/stamps.hpp"
#include "adapters/world_messages.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kEpochSec = 100.0;  // a stamp of zero means unstamped
constexpr const char* kCameraFrame = "camera_optical_frame";

ros::Time stampOf(double world_sec) { return toStamp(kEpochSec + world_sec); }

tf2_msgs::TFMessage tfMsg(const std::vector<geometry_msgs::TransformStamped>& transforms) {
  tf2_msgs::TFMessage message;
  message.transforms = transforms;
  return message;
}

}  // namespace

FlightBag::FlightBag(const std::string& file) { bag_.open(file, rosbag::bagmode::Write); }

void FlightBag::onStart(const simulation::World& world) {
  world_ = &world;
  twist_in_odom_ = world.scenario().odometry.twist_frame == "world";
  const ros::Time stamp = stampOf(0.0);
  bag_.write("/tf_static", stamp, tfMsg(mountingOf(world.T_base_camera(), stamp, frames_, kCameraFrame)));
  bag_.write("/reference", stamp, toReferenceMsg(world, headerOf(stamp, kCameraFrame)));
  bag_.write("/ground_truth/window", stamp,
             toPoseStampedMsg(world.T_odom_window(), headerOf(stamp, frames_.odom)));
}

void FlightBag::onImage(const simulation::CameraFrame& frame, const detection::DetectionTrace&,
                        const std::optional<detection::WindowObservation>&) {
  const ros::Time now = stampOf(world_->timeSec());
  sensor_msgs::CompressedImage picture;
  picture.header = headerOf(stampOf(frame.stamp_sec), kCameraFrame);
  picture.format = "bgr8; jpeg compressed bgr8";
  cv::imencode(".jpg", frame.image, jpeg_, {cv::IMWRITE_JPEG_QUALITY, 95});
  picture.data.assign(jpeg_.begin(), jpeg_.end());
  bag_.write("/image_raw/compressed", now, picture);
  sensor_msgs::CameraInfo info = toMsg(world_->camera());
  info.header = picture.header;
  bag_.write("/camera_info", now, info);
  bag_.write("/ground_truth/window_in_camera", now, toPoseStampedMsg(frame.T_camera_window, picture.header));
}

void FlightBag::onOdometry(const simulation::OdometrySample& sample) {
  const ros::Time now = stampOf(world_->timeSec());
  const auto message = toOdometryMsg(sample, stampOf(sample.stamp_sec), frames_, twist_in_odom_);
  bag_.write("/odom", now, message);
  bag_.write("/tf", now, tfMsg({toTransformStampedMsg(sample.T_odom_base, message.header, frames_.base)}));
}

void FlightBag::onImu(const simulation::ImuSample& sample) {
  bag_.write("/imu", stampOf(world_->timeSec()), toImuMsg(sample, stampOf(sample.stamp_sec), frames_));
}

void FlightBag::onStep(const evaluation::FlightRecord&, const navigation::NavigatorOutput& output) {
  const ros::Time now = stampOf(world_->timeSec());
  geometry_msgs::TwistStamped setpoint;
  setpoint.header = headerOf(now, frames_.odom);
  setpoint.twist.linear = toVectorMsg(output.setpoint.velocity_odom_mps);
  setpoint.twist.angular.z = output.setpoint.yaw_rate_radps;
  if (output.enabled) bag_.write("/cmd_vel", now, setpoint);
  window_ingress::IngressState state = toMsg(output);
  state.header = headerOf(now, frames_.odom);
  bag_.write("/state", now, state);
  bag_.write("/ground_truth/odom", now, toOdometryMsg(world_->truth(), now, frames_));
}

}  // namespace window_ingress::adapters
