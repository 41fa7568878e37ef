#include "simulation/camera/camera_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "../edge_fit.hpp"
#include "simulation/schedule.hpp"
#include "simulation/world.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation::camera_sensor_test {

constexpr double kPeriod_sec = 1.0 / 30.0;

// A broad white frame before a black room.
Scenario blackAndWhite() {
  Scenario scenario;
  scenario.window.frame = scenario.house.wall = {255, 255, 255};
  scenario.window.reveal = {0, 0, 0};
  scenario.window.frame_width_m = 0.25;
  scenario.house.room_light = 0.0;
  return scenario;
}

CameraParams plain() {
  CameraParams params;
  params.noise_grey = params.blur_px = params.exposure_sec = 0.0;
  return params;
}

CameraTruth standingAt(double distance_m, double y_m = 0.0, double z_m = 0.0) {
  CameraTruth motion;
  motion.T_window_camera = geometry::makePose(geometry::R_optical_flu().transpose(), {-distance_m, y_m, z_m});
  return motion;
}

cv::Mat greyOf(const cv::Mat& image) {
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

struct Edge {
  double middle_px, width_px;  // of a smear that is uniform over its width
};

// Measures a vertical edge in row `v` near `u`: mean and standard deviation of the profile's slope.
Edge edgeIn(const cv::Mat& grey, int v, double u, int half_px) {
  double sum = 0.0, first = 0.0, second = 0.0;
  const int centre = static_cast<int>(std::lround(u));
  for (int i = centre - half_px; i < centre + half_px; ++i) {
    const double slope = grey.at<uchar>(v, i + 1) - grey.at<uchar>(v, i), at = i + 0.5 - u;
    sum += slope, first += slope * at, second += slope * at * at;
  }
  const double mean = first / sum, variance = second / sum - mean * mean;
  return {u + mean, std::sqrt(std::max(0.0, 12.0 * variance))};
}

double leftBorder(const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_camera_window,
                  double z_m = 0.0) {
  return camera.project(T_camera_window * Eigen::Vector3d(0.0, 0.6, z_m))->x();
}

TEST(CameraTruth, TurnedItIsThatOfACameraAtTheSamePlace) {
  CameraTruth motion = standingAt(2.0, 0.3, -0.2);
  motion.velocity_window_mps = {0.8, -0.3, 0.2};
  motion.angular_velocity_camera_radps = {0.3, -1.2, 0.4};
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const CameraTruth turned = motion.turned(R);
  for (const double after_sec : {-0.05, 0.0, 0.05}) {
    Eigen::Isometry3d expected = motion.T_camera_window(after_sec);
    expected.prerotate(R);
    EXPECT_LT((turned.T_camera_window(after_sec).matrix() - expected.matrix()).norm(), 1e-12) << after_sec;
  }
}

TEST(CameraSensor, RefusesToReadOutAFisheyeThatNeedsSeveralPlanes) {
  const Scene scene = buildScene(blackAndWhite());
  CameraParams params = plain();
  params.lens = "equidistant";
  params.horizontal_fov_rad = 2.618;
  EXPECT_NO_THROW(CameraSensor(scene, params, 1));
  params.readout_sec = 0.02;
  EXPECT_THROW(CameraSensor(scene, params, 1), std::invalid_argument);
}

TEST(CameraSensor, MotionSmearsAnEdgeBySpeedTimesExposureAroundTheMiddlePose) {
  const Scene scene = buildScene(blackAndWhite());
  CameraParams params = plain();
  params.exposure_sec = 0.010;
  CameraSensor camera(scene, params, 1);
  for (const double speed_mps : {2.5, -2.5, 5.0}) {
    CameraTruth motion = standingAt(4.0);
    motion.velocity_window_mps = {0.0, speed_mps, 0.0};
    const double u = leftBorder(params.model(), motion.T_camera_window(0.0));
    const Edge edge = edgeIn(greyOf(camera.expose(motion, 0, 0.0)), 240, u, 12);
    const double expected_px = params.model().fx / 4.0 * std::abs(speed_mps) * params.exposure_sec;
    EXPECT_NEAR(edge.width_px, expected_px, 0.15 * expected_px);
    EXPECT_NEAR(edge.middle_px, u, 0.05);
  }
}

TEST(CameraSensor, StandingCamerasAndThoseWithoutExposureTimeSmearNothing) {
  const Scene scene = buildScene(blackAndWhite());
  CameraParams params = plain();
  CameraTruth moving = standingAt(4.0);
  moving.velocity_window_mps = {0.0, 3.0, 0.0};
  const cv::Mat instant = CameraSensor(scene, params, 1).expose(moving, 0, 0.0).clone();
  const cv::Mat reference = CameraSensor(scene, params, 1).expose(standingAt(4.0), 0, 0.0).clone();
  params.exposure_sec = 0.02;
  const cv::Mat standing = CameraSensor(scene, params, 1).expose(standingAt(4.0), 0, 0.0).clone();
  EXPECT_EQ(cv::norm(instant, reference, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(standing, reference, cv::NORM_INF), 0.0);
}

TEST(CameraSensor, RollingShutterLeansAnEdgeByTheYawRateWithTheMiddleRowInPlace) {
  const Scene scene = buildScene(blackAndWhite());
  CameraParams params = plain();
  params.readout_sec = 0.02;
  CameraSensor camera(scene, params, 1);
  const geometry::PinholeCamera model = params.model();
  for (const double rate_radps : {1.0, -0.6}) {
    CameraTruth motion = standingAt(3.0);
    motion.angular_velocity_camera_radps = {0.0, rate_radps, 0.0};
    const cv::Mat grey = greyOf(camera.expose(motion, 0, 0.0));
    for (const int v : {180, 210, 270, 300}) {
      const double after_sec = (v - 239.5) / 480.0 * params.readout_sec;
      const double u = leftBorder(model, motion.T_camera_window(after_sec));
      EXPECT_NEAR(edgeIn(grey, v, u, 8).middle_px, u, 0.5) << v;
    }
    const double lean_px = edgeIn(grey, 300, leftBorder(model, motion.T_camera_window(0.0)), 10).middle_px -
                           edgeIn(grey, 180, leftBorder(model, motion.T_camera_window(0.0)), 10).middle_px;
    const double x = (leftBorder(model, motion.T_camera_window(0.0)) - model.cx) / model.fx;
    const double expected_px = -model.fx * (1.0 + x * x) * rate_radps * 120.0 / 480.0 * params.readout_sec;
    EXPECT_NEAR(lean_px, expected_px, 0.1 * std::abs(expected_px) + 0.3);
  }
}

TEST(CameraSensor, BlurMovesNoCorner) {
  const Scenario scenario = blackAndWhite();
  CameraParams params = plain();
  params.blur_px = 1.2;
  params.k1 = -0.15;
  CameraSensor camera(buildScene(scenario), params, 1);
  const geometry::PinholeCamera model = params.model();
  geometry::PinholeCamera straight = model;
  straight.distortion = {};
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int corners = 0;
  for (double distance_m = 2.5; distance_m < 6.0; distance_m += 0.37) {
    const CameraTruth motion = standingAt(distance_m, 0.3 * std::sin(9.0 * distance_m), 0.1);
    const cv::Mat grey = greyOf(camera.expose(motion, 0, 0.0));
    const auto bent = geometry::projectOpening(model, motion.T_camera_window(0.0), scenario.opening());
    const auto expected = geometry::projectOpening(straight, motion.T_camera_window(0.0), scenario.opening());
    const auto measured =
        test::fitCorners(grey, *bent, 7, [&](const Eigen::Vector2d& p) { return model.undistort(p); });
    ASSERT_TRUE(measured);
    for (int i = 0; i < 4; ++i, ++corners) {
      EXPECT_LT(((*measured)[i] - (*expected)[i]).norm(), 0.1);
      sum += (*measured)[i] - (*expected)[i];
    }
  }
  EXPECT_LT((sum / corners).norm(), 0.02);
}

// Mean grey of a standing camera's images over time.
std::vector<double> meansOver(const CameraParams& params, int images, cv::Scalar* last = nullptr) {
  CameraSensor camera(buildScene(Scenario()), params, 1);
  std::vector<double> means;
  for (int i = 0; i < images; ++i) {
    const cv::Scalar mean = cv::mean(camera.expose(standingAt(5.0), i, i * kPeriod_sec));
    means.push_back((mean[0] + mean[1] + mean[2]) / 3.0);
    if (last) *last = mean;
  }
  return means;
}

TEST(CameraSensor, AutoExposureReachesItsTargetWithItsTimeConstant) {
  CameraParams params = plain();
  params.auto_exposure = true;
  params.auto_exposure_sec = 0.5;
  params.target_grey = 90.0;
  params.gain = 0.35;
  const auto means = meansOver(params, 120);
  EXPECT_LT(means.front(), 60.0);
  EXPECT_NEAR(means.back(), 90.0, 2.0);
  const double passed = std::log(means[15] / means.back()) / std::log(means[0] / means.back());
  EXPECT_NEAR(passed, std::exp(-1.0), 0.08) << "15 images are one time constant";

  params.greatest_gain = 0.5;
  const auto limited = meansOver(params, 120);
  EXPECT_NEAR(limited.back() / limited.front(), 0.5 / 0.35, 0.05) << "the greatest gain holds it back";
}

TEST(CameraSensor, WithoutAutoExposureTheGainStays) {
  CameraParams params = plain();
  params.gain = 0.5;
  const auto half = meansOver(params, 3);
  params.gain = 1.0;
  const auto full = meansOver(params, 3);
  EXPECT_NEAR(half[2] / full[2], 0.5, 0.01);
  EXPECT_EQ(half[0], half[2]);
}

TEST(CameraSensor, WarmLightIsReddishUntilTheWhiteBalanceTakesIt) {
  CameraParams params = plain();
  params.gain = 0.5;
  cv::Scalar neutral, warm, balanced;
  meansOver(params, 1, &neutral);
  params.colour_temperature_k = 3000.0;
  meansOver(params, 1, &warm);
  EXPECT_NEAR(warm[1], neutral[1], 0.5) << "green stays";
  EXPECT_GT(warm[2] / neutral[2], 1.15);
  EXPECT_LT(warm[0] / neutral[0], 0.6);
  params.auto_white_balance = true;
  meansOver(params, 60, &balanced);
  EXPECT_NEAR(balanced[0] / balanced[1], 1.0, 0.03);
  EXPECT_NEAR(balanced[2] / balanced[1], 1.0, 0.03);
}

TEST(CameraSensor, NoiseHasTheDeviationOfItsGreyLevel) {
  const Scene scene = buildScene(Scenario());
  CameraParams params = plain();
  const cv::Mat clean = CameraSensor(scene, params, 1).expose(standingAt(5.0), 0, 0.0).clone();
  params.noise_grey = 2.0;
  params.shot_noise_grey = 9.0;
  CameraSensor camera(scene, params, 1);
  std::vector<double> squares(256, 0.0), counts(256, 0.0), sums(256, 0.0);
  for (std::uint64_t index = 0; index < 4; ++index) {
    const cv::Mat noisy = camera.expose(standingAt(5.0), index, 0.0);
    for (int i = 0; i < 3 * 640 * 480; ++i) {
      const int grey = clean.data[i], error = noisy.data[i] - grey;
      ++counts[grey], sums[grey] += error, squares[grey] += error * error;
    }
  }
  int levels = 0;
  for (int grey = 40; grey < 210; ++grey) {
    if (counts[grey] < 4000) continue;
    const double expected = std::sqrt(4.0 + 81.0 * grey / 255.0 + 1.0 / 12.0);
    EXPECT_NEAR(std::sqrt(squares[grey] / counts[grey]), expected, 0.05 * expected) << grey;
    EXPECT_NEAR(sums[grey] / counts[grey], 0.0, 0.3) << grey;
    ++levels;
  }
  EXPECT_GT(levels, 30);
}

TEST(CameraTransport, JitterAndLossHaveTheirSizeAndRepeat) {
  CameraParams params;
  params.latency_jitter_sec = 0.05;
  params.drop_probability = 0.2;
  CameraTransport transport(params, 3), again(params, 3), other(params, 4);
  int lost = 0, different = 0;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const auto arrival = transport.arrivalOf(i * kPeriod_sec);
    EXPECT_EQ(arrival, again.arrivalOf(i * kPeriod_sec));
    different += arrival != other.arrivalOf(i * kPeriod_sec);
    if (!arrival && ++lost) continue;
    const double extra = *arrival - i * kPeriod_sec - params.latency_sec;
    sum += extra, squares += extra * extra;
    EXPECT_GE(extra, -1e-9);
    EXPECT_LE(extra, 0.05 + 1e-9);
  }
  EXPECT_NEAR(lost / 5000.0, 0.2, 0.02);
  const double count = 5000.0 - lost, mean = sum / count;
  EXPECT_NEAR(mean, 0.025, 0.001);
  EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 0.05 / std::sqrt(12.0), 0.001);
  EXPECT_GT(different, 4000);
}

TEST(CameraTransport, InTheWorldNoImageOvertakesAnother) {
  Scenario scenario;
  scenario.camera.width_px = 64;
  scenario.camera.height_px = 48;
  scenario.camera.latency_jitter_sec = 0.2;
  scenario.camera.drop_probability = 0.1;
  World world(scenario, 1);
  double last_sec = -1.0;
  int images = 0;
  while (world.timeSec() < 3.0) {
    world.advance();
    while (const auto frame = world.takeFrame()) {
      EXPECT_GT(frame->stamp_sec, last_sec);
      EXPECT_GE(world.timeSec() - frame->stamp_sec, scenario.camera.latency_sec - 1e-9);
      last_sec = frame->stamp_sec;
      ++images;
    }
  }
  EXPECT_NEAR(images, 0.9 * 30 * 2.8, 10);
}

TEST(CameraParams, ACalibrationFileTakesThePlaceOfTheFieldOfView) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "camera_calibration_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "front.yaml")
      << "image_width: 320\nimage_height: 240\ncamera_name: front\n"
         "camera_matrix: {rows: 3, cols: 3, data: [281, 0, 150.5, 0, 283, 122.5, 0, 0, 1]}\n"
         "distortion_model: plumb_bob\n"
         "distortion_coefficients: {rows: 1, cols: 5, data: [-0.1, 0.02, 0.001, 0, 0]}\n";
  const std::string file = (folder / "scenario.yaml").string();
  std::ofstream(file) << "camera: {calibration_file: front.yaml}\n";
  World world(loadScenario(file, 1), 1);
  EXPECT_EQ(world.camera().fx, 281.0);
  EXPECT_EQ(world.camera().cx, 150.5);
  EXPECT_EQ(world.camera().distortion[0], -0.1);
  std::optional<CameraFrame> frame;
  while (!frame) world.advance(), frame = world.takeFrame();
  EXPECT_EQ(frame->image.size(), cv::Size(320, 240));
  Scenario missing;
  missing.camera.calibration_file = (folder / "missing.yaml").string();
  EXPECT_THROW(World(missing, 1), InputError);
}

TEST(CameraParams, RefusesWhatCannotBe) {
  for (double CameraParams::*field : {&CameraParams::exposure_sec, &CameraParams::readout_sec,
                                      &CameraParams::drop_probability, &CameraParams::shot_noise_grey}) {
    Scenario scenario;
    scenario.camera.*field = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(World(scenario, 1), InputError);
    scenario.camera.*field = -0.1;
    EXPECT_THROW(World(scenario, 1), InputError);
  }
  Scenario scenario;
  scenario.camera.antialiasing = "none";
  EXPECT_THROW(World(scenario, 1), InputError);
}

}  // namespace window_ingress::simulation::camera_sensor_test
