#pragma once

#include <rosbag/bag.h>
#include <sensor_msgs/CompressedImage.h>
#include <tf2_msgs/TFMessage.h>

#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/world/world_messages.hpp"
#include "evaluation/flights/flight_observer.hpp"

namespace window_ingress::adapters {

/// Records a flight of `fly` as the nodes would have published it: camera/{image_raw/compressed (JPEG),
/// camera_info}, odom, imu, tf, reference, cmd_vel, state, ground_truth/{odom, window, window_in_camera}.
/// `replay_bag` and rviz read it.
class FlightBag : public evaluation::FlightObserver {
 public:
  /// Every member function: \throws rosbag::BagException if the file cannot be written
  explicit FlightBag(const std::string& file)
      : bag_(std::make_unique<rosbag::Bag>(file, rosbag::bagmode::Write)) {}
  /// Closes the bag of an interrupted flight silently.
  // Trap: a bag that cannot be closed throws in its own destructor as well, so it must not be destroyed then.
  ~FlightBag() override {
    try {
      if (bag_) bag_->close();
    } catch (const std::exception&) {
      static_cast<void>(bag_.release());
    }
  }

  void onStart(const simulation::World& world) override {
    world_ = &world;
    twist_in_odom_ = world.scenario().odometry.twist_frame == "world";
    const ros::Time stamp = stampOf(0.0);
    bag_->write("/tf_static", stamp, tfMsg(mountingOf(world.T_base_camera(), stamp, frames_, kCameraFrame)));
    bag_->write("/reference", stamp, toReferenceMsg(world, headerOf(stamp, kCameraFrame)));
    bag_->write("/ground_truth/window", stamp,
                toPoseStampedMsg(world.T_odom_window(), headerOf(stamp, frames_.odom)));
  }

  void onImage(const simulation::CameraFrame& frame, const detection::DetectionTrace&,
               const std::optional<detection::WindowObservation>&) override {
    const ros::Time now = stampOf(world_->timeSec());
    sensor_msgs::CompressedImage image;
    image.header = headerOf(stampOf(frame.stamp_sec), kCameraFrame);
    image.format = "bgr8; jpeg compressed bgr8";
    cv::imencode(".jpg", frame.image, jpeg_, {cv::IMWRITE_JPEG_QUALITY, 95});
    image.data.assign(jpeg_.begin(), jpeg_.end());
    bag_->write("/camera/image_raw/compressed", now, image);
    bag_->write("/ground_truth/window_in_camera", now, toPoseStampedMsg(frame.T_camera_window, image.header));
  }

  void onCalibration(const simulation::CalibrationSample& sample) override {
    sensor_msgs::CameraInfo info = toMsg(sample.camera);
    info.header = headerOf(stampOf(sample.stamp_sec), kCameraFrame);
    bag_->write("/camera/camera_info", stampOf(world_->timeSec()), info);
  }

  void onOdometry(const simulation::OdometrySample& sample) override {
    const ros::Time now = stampOf(world_->timeSec());
    const auto message = toOdometryMsg(sample, stampOf(sample.stamp_sec), frames_, twist_in_odom_);
    bag_->write("/odom", now, message);
    bag_->write("/tf", now, tfMsg({toTransformStampedMsg(sample.T_odom_base, message.header, frames_.base)}));
  }

  void onImu(const simulation::ImuSample& sample) override {
    bag_->write("/imu", stampOf(world_->timeSec()), toImuMsg(sample, stampOf(sample.stamp_sec), frames_));
  }

  void onStep(const evaluation::FlightRecord&, const navigation::NavigatorOutput& output) override {
    const ros::Time now = stampOf(world_->timeSec());
    geometry_msgs::TwistStamped setpoint = toTwistMsg(output.setpoint, frames_, std::nullopt);
    setpoint.header.stamp = now;
    if (output.enabled) bag_->write("/cmd_vel", now, setpoint);
    window_ingress::IngressState state = toMsg(output);
    state.header = headerOf(now, frames_.odom);
    bag_->write("/state", now, state);
    bag_->write("/ground_truth/odom", now, toOdometryMsg(world_->truth(), now, frames_));
    if (world_->scenario().sway.amplitude_m > 0.0)
      bag_->write("/ground_truth/window", now,
                  toPoseStampedMsg(world_->T_odom_window(), headerOf(now, frames_.odom)));
  }

  /// Writes the rest and closes the bag.
  void onEnd() override { bag_->close(); }

 private:
  static ros::Time stampOf(double world_sec) { return toStamp(kEpochSec + world_sec); }

  static tf2_msgs::TFMessage tfMsg(const std::vector<geometry_msgs::TransformStamped>& transforms) {
    tf2_msgs::TFMessage message;
    message.transforms = transforms;
    return message;
  }

  static constexpr double kEpochSec = 100.0;  // a stamp of zero means unstamped
  static constexpr const char* kCameraFrame = "camera_optical_frame";

  std::unique_ptr<rosbag::Bag> bag_;
  FrameNames frames_;
  const simulation::World* world_ = nullptr;
  bool twist_in_odom_ = false;
  std::vector<unsigned char> jpeg_;
};

}  // namespace window_ingress::adapters
