#include "frame_set.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace window_ingress::bench {
namespace {

using nlohmann::json;

std::string indexOf(const std::string& folder) { return folder + "/frames.json"; }

json readIndex(const std::string& folder) {
  std::ifstream file(indexOf(folder));
  if (!file) throw std::runtime_error(indexOf(folder) + ": cannot be read; run scripts/bench");
  try {
    return json::parse(file);
  } catch (const json::exception& error) {
    throw std::runtime_error(indexOf(folder) + ": " + error.what());
  }
}

cv::Mat readImage(const std::string& file) {
  cv::Mat image = cv::imread(file, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (image.empty()) throw std::runtime_error(file + ": cannot be read as an image");
  return image;
}

void writeImage(const std::string& file, const cv::Mat& image) {
  if (!cv::imwrite(file, image)) throw std::runtime_error(file + ": cannot be written");
}

geometry::PinholeCamera cameraFrom(const json& node) {
  geometry::PinholeCamera camera;
  camera.width = node.at("width"), camera.height = node.at("height");
  camera.fx = node.at("fx"), camera.fy = node.at("fy");
  camera.cx = node.at("cx"), camera.cy = node.at("cy");
  camera.distortion = node.at("distortion").get<std::array<double, 5>>();
  return camera;
}

json toJson(const geometry::PinholeCamera& camera) {
  return {{"width", camera.width},
          {"height", camera.height},
          {"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"distortion", camera.distortion}};
}

detection::ReferenceAppearance referenceFrom(const std::string& folder, const json& node) {
  const cv::Mat image = readImage(folder + "/" + node.at("picture").get<std::string>());
  if (node.at("corners").is_null()) return detection::ReferenceAppearance(image);
  const auto numbers = node.at("corners").get<std::array<double, 8>>();
  geometry::Quadrilateral opening;
  for (std::size_t i = 0; i < 4; ++i) opening[i] = {numbers[2 * i], numbers[2 * i + 1]};
  return {image, opening};
}

json toJson(const detection::ReferenceAppearance& reference, const std::string& file) {
  json corners = json::array();
  for (const auto& corner : reference.opening()) corners.insert(corners.end(), {corner.x(), corner.y()});
  return {{"picture", file}, {"corners", corners}};
}

Sequence sequenceFrom(const std::string& folder, const json& node) {
  Sequence sequence;
  sequence.name = node.at("name");
  sequence.kind = node.at("kind");
  sequence.period_sec = node.at("period_sec");
  for (const std::string file : node.at("images")) sequence.images.push_back(readImage(folder + "/" + file));
  if (sequence.images.empty()) throw std::runtime_error(indexOf(folder) + ": " + sequence.name + " is empty");
  if (!node.at("camera").is_null()) sequence.camera = cameraFrom(node.at("camera"));
  if (!node.at("reference").is_null()) sequence.reference = referenceFrom(folder, node.at("reference"));
  return sequence;
}

}  // namespace

std::vector<Sequence> readFrameSet(const std::string& folder,
                                   const std::function<bool(const std::string&)>& wanted) {
  std::vector<Sequence> sequences;
  const json index = readIndex(folder);
  try {
    for (const json& node : index)
      if (wanted(node.at("name"))) sequences.push_back(sequenceFrom(folder, node));
  } catch (const json::exception& error) {
    throw std::runtime_error(indexOf(folder) + ": " + error.what());
  }
  return sequences;
}

void addToFrameSet(const std::string& folder, const Sequence& sequence) {
  std::filesystem::create_directories(folder);
  json index = std::filesystem::exists(indexOf(folder)) ? readIndex(folder) : json::array();
  json node = {{"name", sequence.name}, {"kind", sequence.kind}, {"period_sec", sequence.period_sec}};
  for (std::size_t i = 0; i < sequence.images.size(); ++i) {
    const std::string file = sequence.name + "_" + std::to_string(i) + ".png";
    writeImage(folder + "/" + file, sequence.images[i]);
    node["images"].push_back(file);
  }
  node["camera"] = sequence.camera ? toJson(*sequence.camera) : json();
  node["reference"] = json();
  if (sequence.reference) {
    const std::string file = sequence.name + "_reference.png";
    writeImage(folder + "/" + file, sequence.reference->image());
    node["reference"] = toJson(*sequence.reference, file);
  }
  index.push_back(node);
  std::ofstream(indexOf(folder)) << index.dump(1) << "\n";
}

}  // namespace window_ingress::bench
