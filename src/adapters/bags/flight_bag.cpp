#include "adapters/bags/flight_bag.hpp"

#include <sensor_msgs/CompressedImage.h>
#include <tf2_msgs/TFMessage.h>

#include <opencv2/imgcodecs.hpp>

#include "adapters/conversions/stamps.hpp"
#include "adapters/world/world_messages.hpp"

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

FlightBag::FlightBag(const std::string& file)
    : bag_(std::make_unique<rosbag::Bag>(file, rosbag::bagmode::Write)) {}

// A bag that cannot be closed throws in its own destructor, too: it must not be destroyed then.
FlightBag::~FlightBag() {
  try {
    if (bag_) bag_->close();
  } catch (const std::exception&) {
    static_cast<void>(bag_.release());
  }
}

template <typename Message>
void FlightBag::write(const char* topic, const ros::Time& now, const Message& message) {
  bag_->write(topic, now, message);
}

void FlightBag::onStart(const simulation::World& world) {
  world_ = &world;
  twist_in_odom_ = world.scenario().odometry.twist_frame == "world";
  const ros::Time stamp = stampOf(0.0);
  write("/tf_static", stamp, tfMsg(mountingOf(world.T_base_camera(), stamp, frames_, kCameraFrame)));
  write("/reference", stamp, toReferenceMsg(world, headerOf(stamp, kCameraFrame)));
  write("/ground_truth/window", stamp,
        toPoseStampedMsg(world.T_odom_window(), headerOf(stamp, frames_.odom)));
}

void FlightBag::onImage(const simulation::CameraFrame& frame, const detection::DetectionTrace&,
                        const std::optional<detection::WindowObservation>&) {
  const ros::Time now = stampOf(world_->timeSec());
  sensor_msgs::CompressedImage image;
  image.header = headerOf(stampOf(frame.stamp_sec), kCameraFrame);
  image.format = "bgr8; jpeg compressed bgr8";
  cv::imencode(".jpg", frame.image, jpeg_, {cv::IMWRITE_JPEG_QUALITY, 95});
  image.data.assign(jpeg_.begin(), jpeg_.end());
  write("/camera/image_raw/compressed", now, image);
  write("/ground_truth/window_in_camera", now, toPoseStampedMsg(frame.T_camera_window, image.header));
}

void FlightBag::onCalibration(const simulation::CalibrationSample& sample) {
  sensor_msgs::CameraInfo info = toMsg(sample.camera);
  info.header = headerOf(stampOf(sample.stamp_sec), kCameraFrame);
  write("/camera/camera_info", stampOf(world_->timeSec()), info);
}

void FlightBag::onOdometry(const simulation::OdometrySample& sample) {
  const ros::Time now = stampOf(world_->timeSec());
  const auto message = toOdometryMsg(sample, stampOf(sample.stamp_sec), frames_, twist_in_odom_);
  write("/odom", now, message);
  write("/tf", now, tfMsg({toTransformStampedMsg(sample.T_odom_base, message.header, frames_.base)}));
}

void FlightBag::onImu(const simulation::ImuSample& sample) {
  write("/imu", stampOf(world_->timeSec()), toImuMsg(sample, stampOf(sample.stamp_sec), frames_));
}

void FlightBag::onStep(const evaluation::FlightRecord&, const navigation::NavigatorOutput& output) {
  const ros::Time now = stampOf(world_->timeSec());
  geometry_msgs::TwistStamped setpoint = toTwistMsg(output.setpoint, frames_, std::nullopt);
  setpoint.header.stamp = now;
  if (output.enabled) write("/cmd_vel", now, setpoint);
  window_ingress::IngressState state = toMsg(output);
  state.header = headerOf(now, frames_.odom);
  write("/state", now, state);
  write("/ground_truth/odom", now, toOdometryMsg(world_->truth(), now, frames_));
  if (world_->scenario().sway.amplitude_m > 0.0)
    write("/ground_truth/window", now,
          toPoseStampedMsg(world_->T_odom_window(), headerOf(now, frames_.odom)));
}

void FlightBag::onEnd() { bag_->close(); }

}  // namespace window_ingress::adapters
