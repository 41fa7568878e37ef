#pragma once

#include <rosbag/bag.h>

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "adapters/msg_conversion.hpp"
#include "window_ingress/evaluation/flight_observer.hpp"

namespace window_ingress::adapters {

/// Records a flight of `fly` as the nodes would have published it: image_raw/compressed (JPEG), camera_info,
/// odom, imu, tf, reference, cmd_vel, state, ground_truth/{odom, window, window_in_camera}. `replay_bag` and
/// rviz read it.
class FlightBag : public evaluation::FlightObserver {
 public:
  /// \throws rosbag::BagException if the file cannot be written
  explicit FlightBag(const std::string& file);

  void onStart(const simulation::World& world) override;
  void onImage(const simulation::CameraFrame& frame, const detection::DetectionTrace& trace,
               const std::optional<detection::WindowObservation>& window) override;
  void onOdometry(const simulation::OdometrySample& sample) override;
  void onImu(const simulation::ImuSample& sample) override;
  void onStep(const evaluation::FlightRecord& record, const navigation::NavigatorOutput& output) override;

 private:
  rosbag::Bag bag_;
  FrameNames frames_;
  const simulation::World* world_ = nullptr;
  bool twist_in_odom_ = false;
  std::vector<unsigned char> jpeg_;
};

}  // namespace window_ingress::adapters
