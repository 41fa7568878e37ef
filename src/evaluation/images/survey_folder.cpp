#include "evaluation/images/survey_folder.hpp"

#include <array>
#include <opencv2/imgcodecs.hpp>

#include "evaluation/output_file.hpp"
#include "window_ingress/parameters/calibration_file.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

using geometry::Quadrilateral;

constexpr std::size_t kFirstCorner = 7;  // column
const std::vector<int> kFast{cv::IMWRITE_PNG_COMPRESSION, 1};

std::string columns() {
  std::string text = "scenario,seed,distance_m,off_axis_rad,present,has_outer,has_reference";
  for (const char* quad : {"inner", "outer", "far", "reference"}) text += csvCornerColumns(quad);
  return text;
}

Quadrilateral quadrilateral(const CsvReader& row, std::size_t column) {
  Quadrilateral quad;
  for (int i = 0; i < 4; ++i) quad[i] = {row.number(column + 2 * i), row.number(column + 2 * i + 1)};
  return quad;
}

std::string rowOf(const SurveyImage& sample) {
  const SurveyTruth& truth = sample.truth;
  Quadrilateral none;
  none.fill(Eigen::Vector2d::Zero());
  std::string text = sample.scenario + formatted(",%u,%.6f,%.6f,%d,%d,%d", sample.seed, sample.distance_m,
                                                 sample.off_axis_rad, truth.present, truth.outer.has_value(),
                                                 !sample.reference.empty());
  for (const Quadrilateral& quad : {truth.inner, truth.outer.value_or(none), truth.far,
                                    sample.reference.empty() ? none : sample.reference_corners})
    text += csvCorners(quad, "%.9f");
  return text;
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

}  // namespace

std::string SurveyFolder::fileOf(const SurveyImage& sample, const std::string& ending) const {
  return folder_ + "/" + sample.scenario + "_" + std::to_string(sample.seed) + ending;
}

void SurveyFolder::add(const SurveyImage& sample) {
  writeImage(fileOf(sample, ".png"), sample.image, kFast);
  if (!sample.reference.empty()) writeImage(fileOf(sample, ".reference.png"), sample.reference, kFast);
  writeText(fileOf(sample, ".camera.yaml"), calibrationOf(sample.camera));
  rows_.push_back(rowOf(sample));
}

void SurveyFolder::writeTable() const {
  OutputFile table(folder_ + "/truth.csv", columns());
  for (const std::string& row : rows_) table << row << "\n";
  table.finish();
}

void SurveyFolder::forEach(const std::function<void(const SurveyImage&)>& use) const {
  CsvReader rows(folder_ + "/truth.csv", columns());
  while (rows.nextWhole()) use(load(rows));
}

SurveyImage SurveyFolder::load(const CsvReader& row) const {
  SurveyImage sample;
  sample.scenario = row.text(0);
  sample.seed = static_cast<std::uint32_t>(row.number(1));
  sample.distance_m = row.number(2);
  sample.off_axis_rad = row.number(3);
  sample.truth.present = row.number(4) != 0.0;
  sample.truth.inner = quadrilateral(row, kFirstCorner);
  if (row.number(5) != 0.0) sample.truth.outer = quadrilateral(row, kFirstCorner + 8);
  sample.truth.far = quadrilateral(row, kFirstCorner + 16);
  sample.reference_corners = quadrilateral(row, kFirstCorner + 24);
  sample.image = readImage(fileOf(sample, ".png"));
  if (row.number(6) != 0.0) sample.reference = readImage(fileOf(sample, ".reference.png"));
  sample.camera = parameters::readCalibrationFile(fileOf(sample, ".camera.yaml"));
  return sample;
}

}  // namespace window_ingress::evaluation
