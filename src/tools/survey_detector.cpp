/// Measures the detector on random views of scenarios; see --help.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "evaluation/images/detection_survey.hpp"
#include "evaluation/images/survey_folder.hpp"
#include "evaluation/output_file.hpp"
#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/detection/debug_image.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/geometry/euler_angles.hpp"

namespace {

namespace fs = std::filesystem;
using namespace window_ingress;
using Clock = std::chrono::steady_clock;

struct Options {
  std::vector<std::string> scenarios, folders;
  std::string output, params, save, overlay, distance = "2,8", at, antialiasing;
  int frames = 100;
  std::uint32_t seed = 1;
  double off_axis_deg = 45.0;
  bool no_reference = false, still = false, without_target = false;
};

tools::OptionList describe(Options& o) {
  tools::OptionList add(
      "Usage: survey_detector --scenario FILE.yaml... --frames N --output DIR [options]\n"
      "       survey_detector --load DIR... --output DIR [options]\n"
      "Draws random views of each scenario, looks for the window in each, and compares with the truth.\n"
      "Writes DIR/frames.csv and DIR/summary.csv, prints the summary as tables.");
  add("scenario", o.scenarios, "scenario files");
  add("frames", o.frames, "number of frames per scenario", {1, 1e6});
  add("seed", o.seed, "seed of the first frame; each later one uses the next seed");
  add.required("output,o", o.output, "folder of the results");
  add("params", o.params, tools::kParamsHelp);
  add("no-reference", o.no_reference, "gives the detector no image of the target");
  add("distance", o.distance, "NEAREST,FARTHEST [m]");
  add("at", o.at, "D1,D2,...: at these distances in turn, instead of --distance [m]");
  add("off-axis", o.off_axis_deg, "largest angle to either side [deg]", {0.0, 84.9});
  add("static-camera", o.still, "the camera does not move");
  add("without-target", o.without_target, "replaces the target by closed wall");
  add("antialiasing", o.antialiasing, "edges or multisampling; overrides the scenario");
  add("save", o.save, "folder for the images and the truth about them");
  add("overlay", o.overlay, "folder for pictures of the frames that went wrong; truth in white");
  add("load", o.folders, "images from such folders, instead of drawing them");
  return add;
}

std::vector<double> risingDistances(const std::string& option, const std::string& text) {
  const std::vector<double> distances = tools::numbersWithin(option, text, 0.3, 100.0);
  if (!std::is_sorted(distances.begin(), distances.end()))
    throw InputError(option + ": needs rising distances");
  return distances;
}

std::vector<double> fixedDistances(const Options& o) {
  return o.at.empty() ? std::vector<double>() : risingDistances("--at", o.at);
}

// Range of views for the i-th frame.
evaluation::ViewRange rangeOf(const Options& o, int i) {
  const std::vector<double> fixed = fixedDistances(o), range_m = risingDistances("--distance", o.distance);
  if (range_m.size() != 2) throw InputError("--distance: needs two distances");
  evaluation::ViewRange range;
  range.nearest_m = fixed.empty() ? range_m[0] : fixed[i % fixed.size()];
  range.farthest_m = fixed.empty() ? range_m[1] : range.nearest_m;
  range.off_axis_rad = o.off_axis_deg * geometry::kRadPerDegree;
  range.still = o.still;
  return range;
}

/// Searches the window in one image after the other.
class Survey {
 public:
  explicit Survey(const Options& o)
      : options_(o),
        detector_(configuration::readOverlay(o.params).window_detector.detector),
        table_(binsOf(o)) {
    tools::makeFolder(o.output);
    if (!o.overlay.empty()) tools::makeFolder(o.overlay);
    frames_.open(fs::path(o.output) / "frames.csv", evaluation::surveyColumns());
  }

  void look(const evaluation::SurveyImage& sample) {
    if (options_.no_reference || sample.reference.empty())
      detector_.clearReference();
    else
      detector_.setReference(detection::ReferenceAppearance(sample.reference, sample.reference_corners));
    const auto start = Clock::now();
    const auto window = detector_.detect(sample.image, 0.0, &sample.camera);
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    const auto result = evaluation::resultOf(sample, window, detector_.trace(), ms);
    frames_ << evaluation::surveyRow(result) << "\n";
    frames_.finish();
    table_.add(result);
    const bool is_right = result.verdict == evaluation::SurveyVerdict::kHit ||
                          result.verdict == evaluation::SurveyVerdict::kNothing;
    if (!options_.overlay.empty() && !is_right) draw(sample, result);
  }

  void finish() {
    evaluation::writeText(fs::path(options_.output) / "summary.csv", table_.csv());
    std::cout << table_.markdown();
  }

 private:
  static std::vector<evaluation::DistanceBin> binsOf(const Options& o) {
    std::vector<evaluation::DistanceBin> bins;
    for (const double distance_m : fixedDistances(o)) bins.push_back({distance_m, distance_m});
    return bins.empty() ? evaluation::kDefaultBins : bins;
  }

  void draw(const evaluation::SurveyImage& sample, const evaluation::SurveyResult& result) const {
    cv::Mat canvas;
    detection::drawDetection(sample.image, detector_.trace(), result.window ? &*result.window : nullptr,
                             canvas);
    std::vector<cv::Point> corners;
    for (const Eigen::Vector2d& corner : sample.truth.inner)
      corners.emplace_back(cvRound(corner.x()), cvRound(corner.y()));
    if (sample.truth.present) cv::polylines(canvas, corners, true, cv::Scalar::all(255));
    const fs::path file = fs::path(options_.overlay) / (sample.scenario + "_" + std::to_string(sample.seed) +
                                                        "_" + evaluation::toString(result.verdict) + ".png");
    evaluation::writeImage(file, canvas);
  }

  Options options_;
  detection::WindowDetector detector_;
  evaluation::OutputFile frames_;
  evaluation::SurveyTable table_;
};

simulation::Scenario load(const std::string& file, std::uint32_t seed, const Options& o) {
  simulation::Scenario scenario = simulation::loadScenario(file, seed);
  if (!o.antialiasing.empty()) scenario.camera.antialiasing = o.antialiasing;
  if (o.without_target) scenario.window.present = false;
  const auto faults = simulation::faultsOf(scenario);
  if (!faults.empty()) throw InputError(file + ": " + faults[0]);
  return scenario;
}

void drawAndLook(const Options& o, Survey& survey) {
  evaluation::SurveyFolder folder(o.save);
  if (!o.save.empty()) tools::makeFolder(o.save);
  tools::checkNamesDiffer(o.scenarios);
  tools::Progress progress("survey_detector", "images", o.scenarios.size() * o.frames);
  for (const std::string& file : o.scenarios)
    for (int i = 0; i < o.frames; ++i) {
      const std::uint32_t seed = o.seed + static_cast<std::uint32_t>(i);
      auto sample = evaluation::takeImage(load(file, seed, o), seed, rangeOf(o, i), !o.no_reference);
      sample.scenario = fs::path(file).stem().string();
      if (!o.save.empty()) folder.add(sample);
      survey.look(sample);
      progress.passed();
    }
  if (!o.save.empty()) folder.writeTable();
}

int run(const Options& o) {
  if (o.scenarios.empty() == o.folders.empty())
    throw InputError("needs either --scenario or --load; see --help");
  if (!o.folders.empty() && !o.save.empty()) throw InputError("--save has no use with --load");
  Survey survey(o);
  for (const std::string& folder : o.folders)
    evaluation::SurveyFolder(folder).forEach([&](const auto& sample) { survey.look(sample); });
  if (o.folders.empty()) drawAndLook(o, survey);
  survey.finish();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  return tools::runTool("survey_detector", argc, argv, describe, run);
}
