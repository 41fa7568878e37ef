#pragma once

#include <rosbag/bag.h>

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "adapters/conversions/msg_conversion.hpp"
#include "evaluation/flights/flight_observer.hpp"

namespace window_ingress::adapters {

/// Records a flight of `fly` as the nodes would have published it: camera/{image_raw/compressed (JPEG),
/// camera_info}, odom, imu, tf, reference, cmd_vel, state, ground_truth/{odom, window, window_in_camera}.
/// `replay_bag` and rviz read it.
class FlightBag : public evaluation::FlightObserver {
 public:
  /// Here and in every call: \throws rosbag::BagException if the file cannot be written
  explicit FlightBag(const std::string& file);
  /// A flight that was broken off: closes without a word.
  ~FlightBag() override;

  void onStart(const simulation::World& world) override;
  void onImage(const simulation::CameraFrame& frame, const detection::DetectionTrace& trace,
               const std::optional<detection::WindowObservation>& window) override;
  void onCalibration(const simulation::CalibrationSample& sample) override;
  void onOdometry(const simulation::OdometrySample& sample) override;
  void onImu(const simulation::ImuSample& sample) override;
  void onStep(const evaluation::FlightRecord& record, const navigation::NavigatorOutput& output) override;
  void onEnd() override;  ///< writes what is left

 private:
  template <typename Message>
  void write(const char* topic, const ros::Time& now, const Message& message);

  std::unique_ptr<rosbag::Bag> bag_;
  FrameNames frames_;
  const simulation::World* world_ = nullptr;
  bool twist_in_odom_ = false;
  std::vector<unsigned char> jpeg_;
};

}  // namespace window_ingress::adapters
