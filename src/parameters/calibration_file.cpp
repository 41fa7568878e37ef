#include "window_ingress/parameters/calibration_file.hpp"

#include <algorithm>
#include <vector>

#include "parameters/yaml_nodes.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::parameters {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& text) {
  throw InputError(file + ": " + text);
}

std::vector<double> numbers(const YAML::Node& root, const std::string& key, const std::string& file) {
  try {
    const YAML::Node matrix = root[key];
    const auto data = matrix["data"].as<std::vector<double>>();
    const auto count = static_cast<double>(data.size());
    if (matrix["rows"].as<double>(1.0) * matrix["cols"].as<double>(count) == count) return data;
  } catch (const YAML::Exception&) {
    refuse(file, key + ": has no list of numbers named data");
  }
  refuse(file, key + ": rows times cols is not the length of data");
}

int integer(const YAML::Node& root, const std::string& key, const std::string& file) {
  try {
    return root[key].as<int>();
  } catch (const YAML::Exception&) {
    refuse(file, key + ": missing or not an integer");
  }
}

}  // namespace

geometry::PinholeCamera readCalibrationFile(const std::string& file) {
  const YAML::Node root = loadYaml(file);
  if (!root.IsMap()) refuse(file, "is not a camera calibration: not a yaml mapping");
  geometry::PinholeCamera camera;
  camera.width = integer(root, "image_width", file);
  camera.height = integer(root, "image_height", file);
  const auto k = numbers(root, "camera_matrix", file);
  if (k.size() != 9) refuse(file, "camera_matrix: " + std::to_string(k.size()) + " numbers instead of 9");
  if (std::all_of(k.begin(), k.end(), [](double v) { return v == 0.0; }))
    refuse(file, "the camera is uncalibrated (camera_matrix is zero); calibrate it first");
  camera.fx = k[0], camera.cx = k[2], camera.fy = k[4], camera.cy = k[5];
  if (root["distortion_coefficients"]) {
    const auto distortion = numbers(root, "distortion_coefficients", file);
    const std::string model =
        root["distortion_model"] ? root["distortion_model"].as<std::string>("") : "plumb_bob";
    const std::string why = geometry::setLens(model, distortion, camera);
    if (!why.empty()) refuse(file, "distortion_coefficients: " + why);
  }
  const auto faults = camera.validate();
  if (!faults.empty()) refuse(file, joined(faults));
  return camera;
}

}  // namespace window_ingress::parameters
