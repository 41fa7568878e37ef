/// Compares the pose from one image with the truth and with OpenCV; see --help.
#include <filesystem>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <random>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "evaluation/images/survey_folder.hpp"
#include "evaluation/output_file.hpp"
#include "evaluation/poses/pose_chain.hpp"
#include "evaluation/poses/pose_survey.hpp"
#include "params_file.hpp"
#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/parameters/calibration_file.hpp"
#include "window_ingress/text/text.hpp"

namespace {

namespace fs = std::filesystem;
using namespace window_ingress;

struct Options {
  std::vector<std::string> folders;
  std::string output, params, camera, window_size, distances = "2,3,4,6,8", yaws = "0,5,10,15,20,30,45",
                                                   noises = "0.05,0.1,0.2,0.3,0.5";
  int draws = 1000;
  double attitude_deg = 0.0;
  std::uint32_t seed = 1;
};

tools::OptionList describe(Options& o) {
  tools::OptionList add(
      "Usage: survey_pose --draws N --output DIR [options]\n"
      "       survey_pose --load DIR... --window-size W,H --output DIR [options]\n"
      "Draws random views with noisy borders, one cell for each distance, yaw and noise, estimates the pose "
      "and\ncompares it with the truth, with the Cramer-Rao bound, and with OpenCV on the corners where the "
      "same\nborders cross. Writes DIR/cells.csv, prints yaw RMSE over bound as a table.\n"
      "With --load: from the pixels of images that survey_detector has saved to the pose, against the "
      "truth.\nWrites DIR/pictures.csv, prints the errors of poses and of borders as tables.");
  add("draws", o.draws, "number of draws per cell", {1, 1e7});
  add("at", o.distances, "distances [m]");
  add("yaw", o.yaws, "yaws against the line of sight, to either side [deg]");
  add("noise", o.noises, "noise of each pixel along a border [px]");
  add("seed", o.seed, "seed of the first cell; each later one uses the next seed");
  add.required("output,o", o.output, "folder of the results");
  add("camera", o.camera, "calibration without distortion; default 640 x 480, f = 554 px");
  add("window-size", o.window_size, "W,H of the opening; default 1,1 [m]");
  add("load", o.folders, "folders of images");
  add("params", o.params, tools::kParamsHelp);
  add("attitude", o.attitude_deg, "with --load: error of the known attitude [deg]");
  return add;
}

evaluation::PoseSurveySetup setupOf(const Options& o) {
  evaluation::PoseSurveySetup setup;
  if (!o.camera.empty()) setup.camera = parameters::readCalibrationFile(o.camera);
  if (setup.camera.hasDistortion()) throw InputError(o.camera + ": needs a calibration without distortion");
  if (o.window_size.empty()) return setup;
  const auto size = tools::numbers("--window-size", o.window_size, 2);
  if (size[0] < 0.1 || size[1] < 0.1) throw InputError("--window-size: needs 0.1 m at least");
  setup.opening = {size[0], size[1]};
  return setup;
}

int surveyNoise(const Options& o) {
  const auto setup = setupOf(o);
  const auto distances = tools::numbersWithin("--at", o.distances, 0.3, 100.0);
  const auto yaws = tools::numbersWithin("--yaw", o.yaws, 0.0, 80.0);
  const auto noises = tools::numbersWithin("--noise", o.noises, 0.001, 10.0);
  tools::makeFolder(o.output);
  evaluation::OutputFile table(fs::path(o.output) / "cells.csv", evaluation::poseSurveyColumns());
  std::vector<evaluation::PoseCellResult> results;
  std::uint32_t seed = o.seed;
  for (const double noise : noises) {
    for (const double distance : distances)
      for (const double yaw : yaws) {
        results.push_back(
            evaluation::surveyCell(setup, {distance, yaw * geometry::kRadPerDegree, noise}, o.draws, seed++));
        if (results.back().draws == 0)
          throw InputError(formatted("--at: the window does not fit into the image from %g m", distance));
        table << evaluation::poseSurveyRow(results.back()) << "\n";
      }
    std::cerr << "survey_pose: " << results.size() << " cells" << std::endl;
  }
  table.finish();
  std::cout << evaluation::poseSurveyTable(results) << "\n" << evaluation::poseSurveySummary(results);
  return 0;
}

// The attitude as an estimator with this error knows it; nothing if it is not to be known.
std::optional<estimation::GravityPrior> gravityOf(const evaluation::SurveyImage& sample,
                                                  const estimation::PoseParams& params, double sigma_rad,
                                                  std::mt19937& random) {
  if (!(sigma_rad > 0.0)) return std::nullopt;
  const auto truth = evaluation::poseOfTrueCorners(sample.truth.inner, sample.camera,
                                                   {params.opening_width_m, params.opening_height_m});
  if (!truth) return std::nullopt;
  std::normal_distribution<double> noise(0.0, sigma_rad);
  const Eigen::Vector3d off(noise(random), noise(random), noise(random));
  return estimation::GravityPrior{(truth->linear().col(2) + off).normalized(), sigma_rad};
}

int surveyImages(const Options& o) {
  if (o.window_size.empty()) throw InputError("--load needs --window-size");
  tools::makeFolder(o.output);
  const auto overlay = configuration::readOverlay(o.params);
  detection::WindowDetector detector(overlay.window_detector.detector);
  estimation::PoseParams params = overlay.homography_pose.pose;
  tools::takeWindowSize("--window-size", o.window_size, params);
  const estimation::WindowPoseEstimator estimator(params);
  std::mt19937 random(o.seed);
  std::vector<evaluation::PoseChainResult> results;
  for (const std::string& folder : o.folders)
    evaluation::SurveyFolder(folder).forEach([&](const evaluation::SurveyImage& sample) {
      if (sample.reference.empty())
        detector.clearReference();
      else
        detector.setReference(detection::ReferenceAppearance(sample.reference, sample.reference_corners));
      const auto window = detector.detect(sample.image, 0.0, &sample.camera);
      const auto gravity = gravityOf(sample, params, o.attitude_deg * geometry::kRadPerDegree, random);
      results.push_back(evaluation::chainResult(sample, window, estimator, gravity));
    });
  evaluation::OutputFile table(fs::path(o.output) / "pictures.csv", evaluation::poseChainColumns());
  for (const auto& result : results) table << evaluation::poseChainRow(result) << "\n";
  table.finish();
  std::cout << evaluation::poseChainTable(results);
  return 0;
}

int run(const Options& o) { return o.folders.empty() ? surveyNoise(o) : surveyImages(o); }

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  return tools::runTool("survey_pose", argc, argv, describe, run);
}
