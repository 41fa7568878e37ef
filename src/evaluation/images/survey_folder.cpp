#include "evaluation/images/survey_folder.hpp"

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "evaluation/csv.hpp"
#include "evaluation/output_file.hpp"
#include "window_ingress/parameters/calibration_file.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

using geometry::Quadrilateral;

constexpr int kNumbersBeforeCorners = 4;
const std::vector<int> kFast{cv::IMWRITE_PNG_COMPRESSION, 1};

std::string columns() {
  std::string text = "scenario,seed,distance_m,off_axis_rad,present,has_outer,has_reference";
  for (const char* quad : {"inner", "outer", "far", "reference"}) text += csvCornerColumns(quad);
  return text;
}

std::string numbers(const Quadrilateral& quad) { return csvCorners(quad, "%.9f"); }

Quadrilateral quadrilateral(const double* numbers) {
  Quadrilateral quad;
  for (int i = 0; i < 4; ++i) quad[i] = {numbers[2 * i], numbers[2 * i + 1]};
  return quad;
}

std::string rowOf(const SurveyImage& sample) {
  const SurveyTruth& truth = sample.truth;
  const Quadrilateral none = quadrilateral(std::array<double, 8>{}.data());
  return sample.scenario +
         formatted(",%u,%.6f,%.6f,%d,%d,%d", sample.seed, sample.distance_m, sample.off_axis_rad,
                   truth.present, truth.outer.has_value(), !sample.reference.empty()) +
         numbers(truth.inner) + numbers(truth.outer.value_or(none)) + numbers(truth.far) +
         numbers(sample.reference.empty() ? none : sample.reference_corners);
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
  writeImage(fileOf(sample, ".png"), sample.image, kFast);
  if (!sample.reference.empty()) writeImage(fileOf(sample, ".reference.png"), sample.reference, kFast);
  OutputFile calibration(fileOf(sample, ".camera.yaml"));
  calibration << calibrationOf(sample.camera);
  calibration.finish();
  rows_.push_back(rowOf(sample));
}

void SurveyFolder::writeTable() const {
  OutputFile table(std::filesystem::path(folder_) / "truth.csv");
  table << columns() << "\n";
  for (const std::string& row : rows_) table << row << "\n";
  table.finish();
}

void SurveyFolder::readTable() {
  CsvReader rows((std::filesystem::path(folder_) / "truth.csv").string(), columns());
  while (rows.nextWhole()) rows_.push_back(rows.line());
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
