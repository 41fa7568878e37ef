/// Draws the stages of the detector on one image, as the paper's figures 1 and 2, on one sheet.
#include <boost/program_options.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>

#include "command_line.hpp"
#include "evaluation/images/stage_sheet.hpp"
#include "evaluation/output_file.hpp"
#include "scenario_view.hpp"
#include "simulation/camera/reference_image.hpp"
#include "window_ingress/configuration/overlay.hpp"

namespace {

namespace options = boost::program_options;
using namespace window_ingress;

constexpr int kQuality = 75;  // of a jpg

struct Job {
  std::string scenario, image, output, params;
  std::uint32_t seed = 1;
  int cell_width_px = 480;
  tools::ViewOptions view;
};

struct Subject {
  cv::Mat image;
  std::optional<detection::ReferenceAppearance> reference;
};

options::options_description describe(Job& job) {
  options::options_description description(
      "Usage: draw_stages --output SHEET.jpg [OPTION...] --scenario FILE.yaml | IMAGE\n\nOptions");
  auto add = description.add_options();
  add("help,h", "this text");
  add("output,o", options::value(&job.output), "the sheet");
  add("scenario", options::value(&job.scenario), "scenario file; the view is from its start");
  add("seed", options::value(&job.seed)->default_value(job.seed), "of the scenario");
  add("image", options::value(&job.image), "an image instead of a scenario; without a reference");
  add("params", options::value(&job.params), tools::kParamsHelp);
  add("width", options::value(&job.cell_width_px)->default_value(job.cell_width_px),
      "of each picture on the sheet [px]");
  job.view.describe(description);
  return description;
}

Subject photograph(const Job& job) {
  const auto scenario = simulation::loadScenario(job.scenario, job.seed);
  Subject subject{tools::photograph(scenario, job.seed, job.view), std::nullopt};
  geometry::Quadrilateral corners;
  const cv::Mat image = simulation::referenceImage(scenario, &corners);
  subject.reference.emplace(image, corners);
  return subject;
}

int run(const Job& job) {
  if (job.output.empty()) throw InputError("--output is missing; see --help");
  if (job.scenario.empty() == job.image.empty())
    throw InputError("give either a scenario or an image; see --help");
  job.view.check();
  const auto params = configuration::readOverlay(job.params).window_detector.detector;
  const Subject subject =
      job.image.empty() ? photograph(job) : Subject{evaluation::readImage(job.image), std::nullopt};
  const cv::Mat sheet = evaluation::stageSheet(
      subject.image, params, subject.reference ? &*subject.reference : nullptr, job.cell_width_px);
  evaluation::writeImage(job.output, sheet, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  return tools::runTool("draw_stages", argc, argv, describe, run,
                        options::positional_options_description().add("image", 1));
}
