#include <opencv2/imgproc.hpp>

#include "memory_file.hpp"
#include "targets.hpp"
#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/detection/window_tracker.hpp"
#include "window_ingress/estimation/target_estimator.hpp"
#include "window_ingress/navigation/navigator.hpp"
#include "window_ingress/parameters/calibration_file.hpp"
#include "window_ingress/parameters/yaml.hpp"

namespace window_ingress::fuzz {
namespace {

// Valid fields may still contradict each other: constructors report this, and throw nothing else.
template <typename Make>
void construct(Make make) {
  try {
    make();
  } catch (const std::invalid_argument& error) {
    require(error.what()[0] != '\0', "a refusal has words");
  }
}

void detectWith(const detection::DetectorParams& params) {
  cv::Mat image(48, 64, CV_8UC3, cv::Scalar(150, 160, 170));
  cv::rectangle(image, cv::Point(15, 10), cv::Point(48, 36), cv::Scalar(40, 130, 220), cv::FILLED);
  cv::rectangle(image, cv::Point(20, 14), cv::Point(43, 32), cv::Scalar(50, 50, 50), cv::FILLED);
  detection::WindowTracker tracker(params);
  detection::TrackInput input;
  input.image = image;
  for (input.stamp_sec = 1.0; input.stamp_sec < 1.09; input.stamp_sec += 0.033) tracker.update(input);
}

void use(const configuration::Overlay& overlay) {
  construct([&] { detectWith(overlay.window_detector.detector); });
  construct([&] { estimation::WindowPoseEstimator{overlay.homography_pose.pose}; });
  construct([&] {
    const auto& params = overlay.homography_pose;
    estimation::TargetEstimator(params.pose, params.filter, params.tracker);
  });
  construct([&] {
    navigation::Navigator navigator(overlay.ingress_navigator.navigator);
    navigator.start({}, 1.0);
    require(navigator.step({}, 1.02).setpoint.velocity_odom_mps.norm() == 0.0, "without odometry it stands");
  });
}

void calibration(const MemoryFile& file) {
  try {
    require(window_ingress::parameters::readCalibrationFile(file.name()).validate().empty(),
            "an accepted camera is one");
  } catch (const InputError& error) {
    require(std::string(error.what()).find(file.name()) == 0, "a refusal names the file");
  }
}

}  // namespace

void parameters(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  calibration(file);
  configuration::Overlay overlay;
  try {
    overlay = configuration::readOverlay(file.name());
  } catch (const InputError& error) {
    return require(std::string(error.what()).find(file.name()) == 0, "a refusal names the file");
  }
  use(overlay);
}

}  // namespace window_ingress::fuzz
