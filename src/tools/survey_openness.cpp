/// Measures the openness verdict on approaches to open and closed windows; see --help.
#include <cmath>
#include <filesystem>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "evaluation/openness/openness_survey.hpp"
#include "evaluation/output_file.hpp"
#include "simulation/random_stream.hpp"
#include "window_ingress/configuration/overlay.hpp"

namespace {

namespace fs = std::filesystem;
using namespace window_ingress;

struct Options {
  std::vector<std::string> scenarios;
  std::string output, params, trace;
  int open = 0, closed = 0, synthetic = 0, glass = 0;
  std::uint32_t seed = 1;
  evaluation::OpennessRange range;
};

tools::OptionList describe(Options& o) {
  tools::OptionList add(
      "Usage: survey_openness [--open N] [--closed N] [--synthetic N] [--glass N] [--scenario FILE.yaml...] "
      "--output DIR\n"
      "Approaches random windows and asks whether they are open. Writes DIR/openness.csv with a row an "
      "approach and\n"
      "prints a table with Wilson intervals (95 %). Exit code 1 if anything closed was ever called "
      "open.");
  add("open", o.open, "drawn approaches to open windows", {0, 1e6});
  add("closed", o.closed, "drawn approaches to closed ones", {0, 1e6});
  add("synthetic", o.synthetic, "approaches of each kind without images", {0, 1e6});
  add("glass", o.glass, "approaches without images to panes of each of several reflectivities", {0, 1e6});
  add("scenario", o.scenarios, "scenario files instead of random windows, --open approaches each");
  add("seed", o.seed, "seed of the first approach; each later one uses the next seed");
  add("params", o.params, tools::kParamsHelp);
  add("rate", o.range.rate_hz, "image rate [1/s]", {1.0, 120.0});
  add("decide", o.range.decide_m, "distance at which the verdict counts [m]");
  add("trace", o.trace, "csv file: the verdict over each approach");
  add.required("output,o", o.output, "folder of the results");
  return add;
}

std::string oneOf(simulation::RandomStream& random, const std::vector<std::string>& words) {
  return words[static_cast<std::size_t>(random.uniformInt(0, static_cast<int>(words.size()) - 1))];
}

simulation::ColourParams anyColour(simulation::RandomStream& random) {
  simulation::ColourParams colour;
  colour.r = random.uniform(30, 245), colour.g = random.uniform(30, 245), colour.b = random.uniform(30, 245);
  return colour;
}

/// A window of any size, colour, light and surroundings.
simulation::Scenario anyWindow(std::uint32_t seed, bool is_open) {
  simulation::RandomStream random(seed, is_open ? "open window" : "closed window");
  simulation::Scenario scenario;
  auto& window = scenario.window;
  window.width_m = random.uniform(0.9, 1.6);
  window.height_m = random.uniform(0.8, 1.3);
  window.frame = anyColour(random);
  window.frame_width_m = random.uniform(0.0, 1.0) < 0.2 ? 0.0 : random.uniform(0.03, 0.1);
  auto& house = scenario.house;
  house.wall_texture = oneOf(random, {"plaster", "brick", "siding", "stone", "paint"});
  house.wall = anyColour(random);
  house.wall_thickness_m = random.uniform(0.1, 0.35);
  house.texture_seed = random.uniformInt(1, 1000000);
  house.daylight.sun_azimuth_rad = random.uniform(-1.2, 1.2);
  house.room_depth_m = random.uniform(2.0, 6.0);
  house.room_light = random.uniform(0.3, 0.9);
  house.room_texture = oneOf(random, {"plaster", "brick", "siding", "stone"});
  house.furniture = oneOf(random, {"some", "full"});
  scenario.camera.noise_grey = random.uniform(0.5, 4.0);
  scenario.camera.horizontal_fov_rad = random.uniform(1.0, 1.4);
  if (is_open) return scenario;
  window.closed_by = oneOf(random, {"tinted_glass", "curtain", "blinds", "shutter", "board", "poster"});
  window.bars = oneOf(random, {"none", "none", "vertical", "cross"});
  if (window.closed_by != "poster") return scenario;
  window.closed_by = "none", window.present = false, window.frame_width_m = 0.0;
  simulation::PosterParams poster;
  poster.y_m = poster.z_m = 0.0;
  poster.border_m = random.uniform(0.03, 0.1);
  poster.width_m = window.width_m + 2.0 * poster.border_m;
  poster.height_m = window.height_m + 2.0 * poster.border_m;
  poster.border = anyColour(random);
  poster.look = oneOf(random, {"picture", "window"});
  scenario.posters.push_back(poster);
  return scenario;
}

constexpr double kReflectivities[] = {0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0};

std::size_t approaches(const Options& o) {
  const int drawn = o.open * std::max(1, static_cast<int>(o.scenarios.size())) + o.closed;
  return drawn + o.synthetic * (evaluation::kInteriors - 1) + o.glass * std::size(kReflectivities);
}

class Survey {
 public:
  explicit Survey(const Options& o)
      : options_(o), csv_(fs::path(o.output) / "openness.csv", evaluation::opennessColumns()) {
    const auto overlay = configuration::readOverlay(o.params);
    follower_ = overlay.window_detector.interior;
    params_ = overlay.homography_pose.tracker.openness;
    if (!o.trace.empty())
      trace_.open(o.trace, "kind,seed,plane_m,verdict,log_odds,depth_behind_m,open_share,reason");
  }

  void draw(const simulation::Scenario& scenario, std::uint32_t seed, const std::string& kind = "") {
    auto result = evaluation::flyDrawn(scenario, seed, options_.range, follower_, params_, tracer(seed));
    if (!kind.empty()) result.kind = kind;
    take(result);
  }
  void synthesise(evaluation::Interior interior, std::uint32_t seed,
                  std::optional<double> reflectivity = {}) {
    evaluation::OpennessRange range = options_.range;
    range.reflectivity = reflectivity.value_or(range.reflectivity);
    auto result = evaluation::flySynthetic(interior, seed, range, params_, tracer(seed));
    if (reflectivity) result.kind += formatted(" %ld %%", std::lround(100.0 * *reflectivity));
    take(result);
  }
  int finish() {
    std::cout << table_.markdown() << "called open though it is not: " << table_.falseOpen() << std::endl;
    return table_.falseOpen() > 0 ? 1 : 0;
  }

 private:
  void take(const evaluation::OpennessResult& result) {
    table_.add(result);
    csv_ << evaluation::opennessRow(result) << "\n";
    csv_.finish();
    for (const std::string& line : lines_) trace_ << result.kind << "," << line << "\n";
    if (trace_.is_open()) trace_.finish();
    lines_.clear();
    progress_.passed();
  }
  evaluation::OpennessStep tracer(std::uint32_t seed) {
    if (options_.trace.empty()) return {};
    return [this, seed](double plane_m, const openness::OpennessVerdict& v) {
      lines_.push_back(formatted("%u,%.3f,%s,%.3f,%.3f,%.3f,\"%s\"", seed, plane_m,
                                 openness::toString(v.openness), v.log_odds, v.depth_behind_m, v.open_share,
                                 v.reason.c_str()));
    };
  }

  const Options& options_;
  openness::InteriorKltParams follower_;
  openness::OpennessParams params_;
  evaluation::OpennessTable table_;
  evaluation::OutputFile csv_, trace_;
  std::vector<std::string> lines_;
  tools::Progress progress_{"survey_openness", "approaches", approaches(options_)};
};

int run(const Options& o) {
  if (o.open + o.closed + o.synthetic + o.glass < 1)
    throw InputError("nothing to do: --open, --closed, --synthetic or --glass");
  tools::makeFolder(o.output);
  Survey survey(o);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(o.open); ++i) {
    if (o.scenarios.empty()) survey.draw(anyWindow(o.seed + i, true), o.seed + i);
    for (const std::string& file : o.scenarios)
      survey.draw(simulation::loadScenario(file, o.seed + i), o.seed + i, fs::path(file).stem().string());
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(o.closed); ++i)
    survey.draw(anyWindow(o.seed + i, false), o.seed + i);
  for (int kind = 0; kind < evaluation::kInteriors; ++kind) {
    const auto interior = static_cast<evaluation::Interior>(kind);
    if (interior == evaluation::Interior::kGlass) continue;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(o.synthetic); ++i)
      survey.synthesise(interior, o.seed + i);
  }
  for (const double reflectivity : kReflectivities)
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(o.glass); ++i)
      survey.synthesise(evaluation::Interior::kGlass, o.seed + i, reflectivity);
  return survey.finish();
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  return tools::runTool("survey_openness", argc, argv, describe, run);
}
