/// Draws one image of each scenario, as the camera delivers it at the start, on one sheet.
#include <filesystem>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "evaluation/images/contact_sheet.hpp"
#include "evaluation/output_file.hpp"
#include "scenario_view.hpp"

namespace {

using namespace window_ingress;

struct Job {
  std::vector<std::string> files;
  std::string output;
  std::uint32_t seed = 1;
  int columns = 4, cell_width_px = 400;
  tools::ViewOptions view;
};

tools::OptionList describe(Job& job) {
  tools::OptionList add("Usage: draw_scenarios --output SHEET.png [OPTION...] FILE.yaml...");
  add.required("output,o", job.output, "the sheet");
  add("seed", job.seed, "seed of the first scenario; each later one uses the next seed");
  add("columns", job.columns, "images per row", {1, 1000});
  add("width", job.cell_width_px, "width of each image [px]", {64, 4096});
  add("scenario", job.files, "scenario files; need no name");
  job.view.describe(add);
  add.unnamed.add("scenario", -1);
  return add;
}

int run(const Job& job) {
  if (job.files.empty()) throw InputError("no scenario file is given; see --help");
  job.view.check();
  evaluation::ContactSheet sheet(job.columns, job.cell_width_px);
  std::uint32_t seed = job.seed;
  for (const auto& file : job.files) {
    const std::string label = std::filesystem::path(file).stem().string() + ", seed " + std::to_string(seed);
    sheet.add(tools::photograph(simulation::loadScenario(file, seed), seed, job.view), label);
    ++seed;
  }
  evaluation::writeImage(job.output, sheet.draw(), {cv::IMWRITE_JPEG_QUALITY, 85});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  return tools::runTool("draw_scenarios", argc, argv, describe, run);
}
