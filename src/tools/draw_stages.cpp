/// Draws the stages of the detector on one image, as the paper's figures 1 and 2, on one sheet.
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

using namespace window_ingress;

constexpr int kQuality = 75;  // of a jpg

struct Job {
  std::string scenario, image, output, params;
  std::uint32_t seed = 1;
  int cell_width_px = 480;
  tools::ViewOptions view;
};

tools::OptionList describe(Job& job) {
  tools::OptionList add("Usage: draw_stages --output SHEET.jpg [OPTION...] --scenario FILE.yaml | IMAGE");
  add.required("output,o", job.output, "the sheet");
  add("scenario", job.scenario, "scenario file; the view is from its start");
  add("seed", job.seed, "seed of the scenario");
  add("image", job.image, "an image instead of a scenario; without a reference");
  add("params", job.params, tools::kParamsHelp);
  add("width", job.cell_width_px, "width of each image on the sheet [px]", {64, 4096});
  job.view.describe(add);
  add.unnamed.add("image", 1);
  return add;
}

int run(const Job& job) {
  if (job.scenario.empty() == job.image.empty())
    throw InputError("give either a scenario or an image; see --help");
  job.view.check();
  const auto params = configuration::readOverlay(job.params).window_detector.detector;
  cv::Mat image;
  std::optional<detection::ReferenceAppearance> reference;
  if (job.image.empty()) {
    const auto scenario = simulation::loadScenario(job.scenario, job.seed);
    image = tools::photograph(scenario, job.seed, job.view);
    geometry::Quadrilateral corners;
    const cv::Mat of_target = simulation::referenceImage(scenario, &corners);
    reference.emplace(of_target, corners);
  } else {
    image = evaluation::readImage(job.image);
  }
  const cv::Mat sheet =
      evaluation::stageSheet(image, params, reference ? &*reference : nullptr, job.cell_width_px);
  evaluation::writeImage(job.output, sheet, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  return tools::runTool("draw_stages", argc, argv, describe, run);
}
