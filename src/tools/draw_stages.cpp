/// Draws the stages of the detector on one image, as the paper's figures 1 and 2, on one sheet.
#include <boost/program_options.hpp>
#include <filesystem>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "command_line.hpp"
#include "evaluation/images/stage_sheet.hpp"
#include "simulation/world.hpp"
#include "window_ingress/configuration/overlay.hpp"

namespace {

namespace options = boost::program_options;
using namespace window_ingress;
using tools::UsageError;

constexpr double kSettling_sec = 0.4;  // until the camera has seen the scene
constexpr int kQuality = 75;           // of a jpg

struct Job {
  std::string scenario, image, output, params;
  std::uint32_t seed = 1;
  int cell_width_px = 480;
  double distance_m = 0.0, off_axis_rad = 0.0;  // 0 m: as the scenario has it
};

struct Subject {
  cv::Mat image;
  std::optional<detection::ReferenceAppearance> reference;
};

options::options_description describe(Job& job) {
  options::options_description description(
      "Usage: draw_stages --output SHEET.jpg [OPTION...] --scenario FILE.yaml | IMAGE\n\nOptions");
  description.add_options()("help", "print this text")                                                  //
      ("output", options::value(&job.output), "the sheet")                                              //
      ("scenario", options::value(&job.scenario), "scenario file; the view is from its start")          //
      ("seed", options::value(&job.seed)->default_value(1), "of the scenario")                          //
      ("distance", options::value(&job.distance_m), "instead of the start's [m]")                       //
      ("off-axis", options::value(&job.off_axis_rad), "with --distance: instead of the start's [rad]")  //
      ("image", options::value(&job.image), "an image instead of a scenario; without a reference")      //
      ("params", options::value(&job.params), tools::kParamsHelp)                                       //
      ("width", options::value(&job.cell_width_px)->default_value(480), "of each picture on the sheet [px]");
  return description;
}

// From the start, but looking at the window.
Subject photograph(const Job& job) {
  auto scenario = simulation::loadScenario(job.scenario, job.seed);
  scenario.start.heading_rad = 0.0;
  if (job.distance_m > 0.0) {
    scenario.start.distance_m = job.distance_m;
    scenario.start.off_axis_rad = job.off_axis_rad;
    scenario.start.height_offset_m = 0.0;
  }
  simulation::World world(scenario, job.seed);
  Subject subject;
  while (subject.image.empty() || world.timeSec() < kSettling_sec) {
    world.advance();
    if (const auto frame = world.takeFrame()) subject.image = frame->image.clone();
  }
  geometry::Quadrilateral corners;
  const cv::Mat image = world.referenceImage(&corners);
  subject.reference.emplace(image, corners);
  return subject;
}

Subject read(const Job& job) {
  Subject subject;
  if (std::filesystem::exists(job.image))  // OpenCV warns by itself of a file that is not there
    subject.image = cv::imread(job.image, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (subject.image.empty()) throw UsageError(job.image + ": cannot be read as an image");
  return subject;
}

int run(const Job& job) {
  if (job.output.empty()) throw UsageError("--output is missing; see --help");
  if (job.scenario.empty() == job.image.empty())
    throw UsageError("give either a scenario or an image; see --help");
  if (!(job.distance_m >= 0.0)) throw UsageError("--distance: needs metres, above 0");
  if (job.off_axis_rad != 0.0 && job.distance_m == 0.0) throw UsageError("--off-axis needs --distance");
  const auto params = configuration::readOverlay(job.params).window_detector.detector;
  const Subject subject = job.image.empty() ? photograph(job) : read(job);
  const cv::Mat sheet = evaluation::stageSheet(
      subject.image, params, subject.reference ? &*subject.reference : nullptr, job.cell_width_px);
  if (!cv::imwrite(job.output, sheet, {cv::IMWRITE_JPEG_QUALITY, kQuality}))
    throw std::runtime_error(job.output + ": cannot write");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  return tools::runTool("draw_stages", argc, argv, describe, run,
                        options::positional_options_description().add("image", 1));
}
