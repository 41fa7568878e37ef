#include "evaluation/images/survey_folder.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>

#include "evaluation/flights/flight_table.hpp"
#include "window_ingress/parameters/calibration_file.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

using geometry::Quadrilateral;

constexpr int kNumbersBeforeCorners = 4, kQuads = 4;
constexpr int kColumns = 1 + kNumbersBeforeCorners + 2 + 8 * kQuads;

std::string columns() {
  std::string text = "scenario,seed,distance_m,off_axis_rad,present,has_outer,has_reference";
  for (const char* quad : {"inner", "outer", "far", "reference"})
    for (int i = 1; i <= 4; ++i)
      for (const char* axis : {"x", "y"}) text += std::string(",") + quad + "_" + axis + std::to_string(i);
  return text;
}

std::string numbers(const Quadrilateral& quad) {
  std::string text;
  for (const Eigen::Vector2d& corner : quad)
    text += "," + formatted("%.9f", corner.x()) + "," + formatted("%.9f", corner.y());
  return text;
}

Quadrilateral quadrilateral(const double* numbers) {
  Quadrilateral quad;
  for (int i = 0; i < 4; ++i) quad[i] = {numbers[2 * i], numbers[2 * i + 1]};
  return quad;
}

std::string rowOf(const SurveyImage& sample) {
  const SurveyTruth& truth = sample.truth;
  const Quadrilateral none = quadrilateral(std::array<double, 8>{}.data());
  return sample.scenario + "," + std::to_string(sample.seed) + "," + formatted("%.6f", sample.distance_m) +
         "," + formatted("%.6f", sample.off_axis_rad) + "," + (truth.present ? "1," : "0,") +
         (truth.outer ? "1," : "0,") + (sample.reference.empty() ? "0" : "1") + numbers(truth.inner) +
         numbers(truth.outer.value_or(none)) + numbers(truth.far) +
         numbers(sample.reference.empty() ? none : sample.reference_corners);
}

void writeImage(const std::string& file, const cv::Mat& image) {
  if (!cv::imwrite(file, image, {cv::IMWRITE_PNG_COMPRESSION, 1}))
    throw std::runtime_error(file + ": cannot be written; is the disk full?");
}

cv::Mat readImage(const std::string& file) {
  const cv::Mat image = cv::imread(file, cv::IMREAD_COLOR);
  if (image.empty()) throw TableError(file + ": cannot be read as an image");
  return image;
}

void writeText(const std::string& file, const std::string& text) {
  std::ofstream output(file);
  output << text;
  if (!output.flush()) throw std::runtime_error(file + ": cannot be written; is the disk full?");
}

std::string calibrationOf(const geometry::PinholeCamera& camera) {
  const auto list = [](const auto& values) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ", ") + formatted("%.17g", value);
    return "[" + text + "]";
  };
  const std::array<double, 9> k{camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  const bool fisheye = camera.model == geometry::LensModel::kEquidistant;
  std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  if (fisheye) distortion.pop_back();
  return "image_width: " + std::to_string(camera.width) + "\nimage_height: " + std::to_string(camera.height) +
         "\ncamera_matrix: {rows: 3, cols: 3, data: " + list(k) +
         "}\ndistortion_model: " + (fisheye ? "equidistant" : "plumb_bob") +
         "\ndistortion_coefficients: {rows: 1, cols: " + std::to_string(distortion.size()) +
         ", data: " + list(distortion) + "}\n";
}

std::vector<double> numbersOf(std::istringstream& row) {
  std::vector<double> values;
  for (std::string part; std::getline(row, part, ',');) values.push_back(std::strtod(part.c_str(), nullptr));
  return values;
}

}  // namespace

std::string SurveyFolder::fileOf(const SurveyImage& sample, const std::string& ending) const {
  return (std::filesystem::path(folder_) / (sample.scenario + "_" + std::to_string(sample.seed) + ending))
      .string();
}

void SurveyFolder::add(const SurveyImage& sample) {
  writeImage(fileOf(sample, ".png"), sample.image);
  if (!sample.reference.empty()) writeImage(fileOf(sample, ".reference.png"), sample.reference);
  writeText(fileOf(sample, ".camera.yaml"), calibrationOf(sample.camera));
  rows_.push_back(rowOf(sample));
}

void SurveyFolder::writeTable() const {
  std::string text = columns() + "\n";
  for (const std::string& row : rows_) text += row + "\n";
  writeText((std::filesystem::path(folder_) / "truth.csv").string(), text);
}

void SurveyFolder::readTable() {
  const std::string file = (std::filesystem::path(folder_) / "truth.csv").string();
  std::ifstream input(file);
  std::string line;
  if (!std::getline(input, line)) throw TableError(file + ": cannot be read, or empty");
  if (line != columns())
    throw TableError(file + ":1: other columns than expected; written by another version?");
  while (std::getline(input, line)) {
    if (std::count(line.begin(), line.end(), ',') != kColumns - 1)
      throw TableError(file + ":" + std::to_string(rows_.size() + 2) + ": a field is missing");
    rows_.push_back(line);
  }
}

SurveyImage SurveyFolder::load(int i) const {
  std::istringstream row(rows_.at(i));
  SurveyImage sample;
  std::getline(row, sample.scenario, ',');
  const std::vector<double> values = numbersOf(row);
  const double* quads = values.data() + kNumbersBeforeCorners + 2;
  sample.seed = static_cast<std::uint32_t>(values[0]);
  sample.distance_m = values[1];
  sample.off_axis_rad = values[2];
  sample.truth.present = values[3] != 0.0;
  sample.truth.inner = quadrilateral(quads);
  if (values[4] != 0.0) sample.truth.outer = quadrilateral(quads + 8);
  sample.truth.far = quadrilateral(quads + 16);
  sample.reference_corners = quadrilateral(quads + 24);
  sample.image = readImage(fileOf(sample, ".png"));
  if (values[5] != 0.0) sample.reference = readImage(fileOf(sample, ".reference.png"));
  sample.camera = parameters::readCalibrationFile(fileOf(sample, ".camera.yaml"));
  return sample;
}

}  // namespace window_ingress::evaluation
