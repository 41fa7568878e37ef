/// Draws one image of each scenario, as the camera delivers it from the start, on one sheet.
#include <boost/program_options.hpp>
#include <filesystem>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "simulation/world.hpp"

namespace {

namespace options = boost::program_options;
using namespace window_ingress;
using tools::UsageError;

constexpr double kSettling_sec = 0.4;  // until the camera has seen the scene

struct Job {
  std::vector<std::string> files;
  std::string output;
  std::uint32_t seed = 1;  // of the first one
  int columns = 4, cell_width_px = 400;
  double distance_m = 0.0, off_axis_rad = 0.0;  // 0 m: as the scenario has it
};

options::options_description describe() {
  options::options_description description(
      "Usage: draw_scenarios --output SHEET.png [OPTION...] FILE.yaml...\n\nOptions");
  auto add = description.add_options();
  add("help", "print this text");
  add("output", options::value<std::string>(), "the sheet");
  add("seed", options::value<std::uint32_t>()->default_value(1),
      "of the first scenario; each further one has the next");
  add("columns", options::value<int>()->default_value(4), "pictures in a row");
  add("width", options::value<int>()->default_value(400), "of each picture [px]");
  add("distance", options::value<double>()->default_value(0.0), "instead of the start's [m]");
  add("off-axis", options::value<double>()->default_value(0.0),
      "with --distance: instead of the start's [rad]");
  add("scenario", options::value<std::vector<std::string>>(), "scenario files");
  return description;
}

Job parse(int argc, char** argv, const options::options_description& description) {
  options::positional_options_description rest;
  rest.add("scenario", -1);
  const auto given = tools::parsed(argc, argv, description, rest);
  Job job;
  if (given.count("help") != 0) {
    std::cout << description;
    return job;
  }
  if (given.count("output") == 0) throw UsageError("--output is missing; see --help");
  if (given.count("scenario") == 0) throw UsageError("no scenario file is given; see --help");
  job.output = given["output"].as<std::string>();
  job.files = given["scenario"].as<std::vector<std::string>>();
  job.seed = given["seed"].as<std::uint32_t>();
  job.columns = given["columns"].as<int>();
  job.cell_width_px = given["width"].as<int>();
  job.distance_m = given["distance"].as<double>();
  job.off_axis_rad = given["off-axis"].as<double>();
  if (job.columns < 1 || job.cell_width_px < 64) throw UsageError("--columns or --width is too small");
  return job;
}

// From the start, but looking at the window.
cv::Mat photograph(simulation::Scenario scenario, std::uint32_t seed, const Job& job) {
  scenario.start.heading_rad = 0.0;
  if (job.distance_m > 0.0) {
    scenario.start.distance_m = job.distance_m;
    scenario.start.off_axis_rad = job.off_axis_rad;
    scenario.start.height_offset_m = 0.0;
  }
  simulation::World world(scenario, seed);
  cv::Mat image;
  while (image.empty() || world.timeSec() < kSettling_sec) {
    world.advance();
    if (const auto frame = world.takeFrame()) image = frame->image.clone();
  }
  return image;
}

cv::Mat labelled(const cv::Mat& image, const std::string& label, int width_px) {
  constexpr int kLabel_px = 26;
  cv::Mat cell;
  const int height_px = width_px * image.rows / image.cols;
  cv::resize(image, cell, cv::Size(width_px, height_px), 0, 0, cv::INTER_AREA);
  cv::copyMakeBorder(cell, cell, kLabel_px, 4, 2, 2, cv::BORDER_CONSTANT, cv::Scalar::all(255));
  cv::putText(cell, label, cv::Point(6, kLabel_px - 8), cv::FONT_HERSHEY_SIMPLEX, 0.55, cv::Scalar::all(0), 1,
              cv::LINE_AA);
  return cell;
}

cv::Mat sheetOf(const std::vector<cv::Mat>& cells, int columns) {
  const int used = std::min<int>(columns, static_cast<int>(cells.size()));
  const int rows = (static_cast<int>(cells.size()) + used - 1) / used;
  cv::Size size = cells[0].size();
  for (const auto& cell : cells) size.height = std::max(size.height, cell.rows);
  cv::Mat sheet(rows * size.height, used * size.width, CV_8UC3, cv::Scalar::all(255));
  for (int i = 0; i < static_cast<int>(cells.size()); ++i) {
    const cv::Point corner(i % used * size.width, i / used * size.height);
    cells[i].copyTo(sheet(cv::Rect(corner, cells[i].size())));
  }
  return sheet;
}

int run(const Job& job) {
  std::vector<cv::Mat> cells;
  std::uint32_t seed = job.seed;
  for (const auto& file : job.files) {
    const std::string label = std::filesystem::path(file).stem().string() + ", seed " + std::to_string(seed);
    cells.push_back(
        labelled(photograph(simulation::loadScenario(file, seed), seed, job), label, job.cell_width_px));
    ++seed;
  }
  if (!cv::imwrite(job.output, sheetOf(cells, job.columns), {cv::IMWRITE_JPEG_QUALITY, 85}))
    throw std::runtime_error(job.output + ": cannot write");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  return tools::runTool("draw_scenarios", [&] {
    const Job job = parse(argc, argv, describe());
    return job.files.empty() ? 0 : run(job);
  });
}
