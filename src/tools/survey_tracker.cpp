/// Measures the tracker on flights towards the window; see --help.
#include <chrono>
#include <filesystem>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "evaluation/images/survey_flight.hpp"
#include "evaluation/images/survey_image.hpp"
#include "evaluation/images/track_survey.hpp"
#include "evaluation/output_file.hpp"
#include "simulation/camera/camera_sensor.hpp"
#include "simulation/camera/reference_image.hpp"
#include "simulation/random_stream.hpp"
#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/detection/window_tracker.hpp"

namespace {

namespace fs = std::filesystem;
using namespace window_ingress;
using Clock = std::chrono::steady_clock;

constexpr double kAttitudeNoise_rad = 0.002, kAttitudeBias_rad = 0.01;

struct Options {
  std::vector<std::string> scenarios;
  std::string output, params;
  int flights = 5;
  std::uint32_t seed = 1;
  bool no_reference = false, no_attitude = false;
  evaluation::FlightRange range;
};

tools::OptionList describe(Options& o) {
  tools::OptionList add(
      "Usage: survey_tracker --scenario FILE.yaml... --flights N --output DIR [options]\n"
      "Follows the window on random flights towards it, without a navigator, and compares with the truth.\n"
      "Writes DIR/<scenario>.csv with a row a frame, prints a table.");
  add("scenario", o.scenarios, "scenario files");
  add("flights", o.flights, "number of flights per scenario", {1, 1e6});
  add("seed", o.seed, "seed of the first flight; each later one uses the next seed");
  add.required("output,o", o.output, "folder of the results");
  add("params", o.params, tools::kParamsHelp);
  add("speed", o.range.speed_mps, "speed towards the plane [m/s]", {0.1, 10.0});
  add("end", o.range.end_m, "distance from the plane at which the flight ends [m]", {0.2, 3.0});
  add("wobble", o.range.wobble_rad, "wobble of the attitude [rad]", {0.0, 0.3});
  add("no-reference", o.no_reference, "gives the detector no image of the target");
  add("no-attitude", o.no_attitude, "the tracker does not know the attitude");
  return add;
}

/// An attitude estimate with a constant error and noise.
class Attitude {
 public:
  explicit Attitude(std::uint32_t seed) : random_(seed, "attitude"), bias_(draw(kAttitudeBias_rad)) {}
  Eigen::Matrix3d of(const Eigen::Matrix3d& truth) { return bias_ * truth * draw(kAttitudeNoise_rad); }

 private:
  Eigen::Matrix3d draw(double sigma_rad) {
    const Eigen::Vector3d turn = random_.normals(sigma_rad);
    return (Eigen::AngleAxisd(turn.x(), Eigen::Vector3d::UnitX()) *
            Eigen::AngleAxisd(turn.y(), Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(turn.z(), Eigen::Vector3d::UnitZ()))
        .toRotationMatrix();
  }
  simulation::RandomStream random_;
  Eigen::Matrix3d bias_;
};

/// One flight of one scenario and seed.
class Flight {
 public:
  Flight(const std::string& file, std::uint32_t seed, const Options& o)
      : options_(o),
        seed_(seed),
        scenario_(simulation::loadScenario(file, seed)),
        camera_(scenario_.camera.model()),
        scene_(simulation::buildScene(scenario_)),
        sensor_(scene_, scenario_.camera, seed),
        path_(o.range, seed),
        attitude_(seed),
        tracker_(configuration::readOverlay(o.params).window_detector.detector) {
    if (o.no_reference) return;
    geometry::Quadrilateral corners;
    const cv::Mat image = simulation::referenceImage(scenario_, &corners);
    tracker_.setReference(detection::ReferenceAppearance(image, corners));
  }

  template <typename Use>
  void fly(const Use& use) {
    const double period_sec = 1.0 / scenario_.camera.rate_hz;
    for (int i = 0; i * period_sec < path_.durationSec(); ++i)
      if (const auto result = look(i, i * period_sec)) use(*result);
  }

 private:
  std::optional<evaluation::TrackResult> look(int index, double time_sec) {
    const simulation::CameraTruth motion = path_.motion(time_sec);
    const double stamp_sec = kFirstStamp_sec + time_sec;
    const auto truth = evaluation::surveyTruth(scenario_, scene_, camera_, motion);
    detection::TrackInput input;
    input.image = sensor_.expose(motion, static_cast<std::uint64_t>(index), stamp_sec);
    input.stamp_sec = stamp_sec;
    input.camera = &camera_;
    if (!options_.no_attitude) input.R_world_camera = attitude_.of(motion.T_window_camera.linear());
    evaluation::TrackResult result;
    result.searched = !tracker_.tracking();
    const auto start = Clock::now();
    result.window = tracker_.update(input);
    result.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    if (!truth) return std::nullopt;
    result.seed = seed_;
    result.frame = index;
    result.plane_m = -motion.T_window_camera.translation().x();
    result.truth = *truth;
    evaluation::judge(result, camera_);
    return result;
  }

  static constexpr double kFirstStamp_sec = 100.0;
  const Options& options_;
  std::uint32_t seed_;
  simulation::Scenario scenario_;
  geometry::PinholeCamera camera_;
  simulation::Scene scene_;
  simulation::CameraSensor sensor_;
  evaluation::SurveyFlight path_;
  Attitude attitude_;
  detection::WindowTracker tracker_;
};

int run(const Options& o) {
  if (o.scenarios.empty()) throw InputError("--scenario is missing; see --help");
  tools::checkNamesDiffer(o.scenarios);
  tools::makeFolder(o.output);
  std::cout << evaluation::TrackSummary::markdownHeader();
  tools::Progress progress("survey_tracker", "flights", o.scenarios.size() * o.flights);
  for (const std::string& file : o.scenarios) {
    const std::string name = fs::path(file).stem().string();
    evaluation::OutputFile table(fs::path(o.output) / (name + ".csv"), evaluation::trackColumns());
    evaluation::TrackSummary summary;
    for (int i = 0; i < o.flights; ++i, progress.passed())
      Flight(file, o.seed + static_cast<std::uint32_t>(i), o).fly([&](const evaluation::TrackResult& result) {
        table << evaluation::trackRow(result) << "\n";
        summary.add(result);
      });
    table.finish();
    std::cout << summary.markdown(name) << std::flush;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  return tools::runTool("survey_tracker", argc, argv, describe, run);
}
