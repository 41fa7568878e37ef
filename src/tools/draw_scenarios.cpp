/// Draws one image of each scenario, as the camera delivers it from the start, on one sheet.
#include <boost/program_options.hpp>
#include <filesystem>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "evaluation/images/contact_sheet.hpp"
#include "evaluation/output_file.hpp"
#include "scenario_view.hpp"

namespace {

namespace options = boost::program_options;
using namespace window_ingress;

struct Job {
  std::vector<std::string> files;
  std::string output;
  std::uint32_t seed = 1;
  int columns = 4, cell_width_px = 400;
  tools::ViewOptions view;
};

options::options_description describe(Job& job) {
  options::options_description description(
      "Usage: draw_scenarios --output SHEET.png [OPTION...] FILE.yaml...\n\nOptions");
  auto add = description.add_options();
  add("help,h", "this text");
  add("output,o", options::value(&job.output), "the sheet");
  add("seed", options::value(&job.seed)->default_value(job.seed),
      "of the first scenario; each further one has the next");
  add("columns", options::value(&job.columns)->default_value(job.columns), "pictures in a row");
  add("width", options::value(&job.cell_width_px)->default_value(job.cell_width_px), "of each picture [px]");
  add("scenario", options::value(&job.files), "scenario files; need no name");
  job.view.describe(description);
  return description;
}

int run(const Job& job) {
  if (job.output.empty()) throw InputError("--output is missing; see --help");
  if (job.files.empty()) throw InputError("no scenario file is given; see --help");
  if (job.columns < 1 || job.cell_width_px < 64) throw InputError("--columns or --width is too small");
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
  return tools::runTool("draw_scenarios", argc, argv, describe, run,
                        options::positional_options_description().add("scenario", -1));
}
