/// M25 to M36: invalid calibrations.
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "adapters/conversions/msg_conversion.hpp"
#include "drawn_window.hpp"
#include "sample_camera_info.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/calibration_file.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters::calibration_faults_test {

using sensor_msgs::CameraInfo;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

struct Refusal {
  std::function<void(CameraInfo&)> spoil;
  std::string word;
  bool rectified = false;
};

void expectRefused(const std::vector<Refusal>& all) {
  std::string reason;
  for (const Refusal& refusal : all) {
    CameraInfo info = test::sampleCameraInfo();
    refusal.spoil(info);
    const auto camera = cameraFromMsg(info, refusal.rectified);
    EXPECT_FALSE(camera.value) << refusal.word;
    EXPECT_NE(camera.reason.find(refusal.word), std::string::npos)
        << refusal.word << " is not in: " << camera.reason;
    reason = camera.reason;
  }
  testing::Test::RecordProperty("seen",
                                std::to_string(all.size()) + " refused, e.g.: " + reason.substr(0, 120));
}

TEST(Fault, M25_ZeroK) {
  expectRefused(
      {{[](auto& info) { info.K.assign(0.0); }, "uncalibrated"},
       {[](auto& info) { info.K.assign(0.0); }, "uncalibrated", true},
       {[](auto& info) { info.K.assign(0.0), info.P.assign(0.0), info.R.assign(0.0); }, "uncalibrated"}});
}

TEST(Fault, M26_NumbersThatAreNone) {
  std::vector<Refusal> all;
  for (const double bad : {kNan, kInf, -kInf})
    for (std::size_t i = 0; i < 12; ++i) {
      if (i < 9) all.push_back({[=](auto& info) { info.K[i] = bad; }, "not finite"});
      if (i < 9) all.push_back({[=](auto& info) { info.R[i] = bad; }, "not finite"});
      if (i < 5) all.push_back({[=](auto& info) { info.D[i] = bad; }, "not finite"});
      all.push_back({[=](auto& info) { info.P[i] = bad; }, "not finite"});
    }
  for (const bool rectified : {false, true})
    all.push_back({[](auto& info) { info.R.assign(0.0); }, "R is zero", rectified});
  all.push_back({[](auto& info) { info.K[0] = -554.0; }, "focal length in K must be positive"});
  all.push_back({[](auto& info) { info.K[4] = -554.0; }, "focal length in K must be positive"});
  all.push_back({[](auto& info) { info.P[0] = -500.0; }, "focal length in P must be positive", true});
  expectRefused(all);
}

TEST(Fault, M27_ZeroP) {
  CameraInfo info = test::sampleCameraInfo();
  info.P.assign(0.0);
  for (int by_hand = 0; by_hand < 2; ++by_hand) {  // a K written by hand leaves R zero, too
    const auto raw = cameraFromMsg(info, false);
    ASSERT_TRUE(raw) << raw.reason;
    EXPECT_EQ(raw.value->fx, 554.0);
    EXPECT_EQ(raw.value->distortion[0], -0.2);
    info.R.assign(0.0);
  }
  expectRefused({{[](auto& i) { i.P.assign(0.0); }, "P is zero", true}});
}

TEST(Fault, M28_DOfTheWrongLength) {
  std::vector<Refusal> all;
  for (const std::size_t length : {1u, 3u, 6u, 8u, 100000u})
    all.push_back({[=](auto& info) { info.D.assign(length, 0.01); }, "D holds " + std::to_string(length)});
  for (const std::size_t length : {0u, 3u, 5u, 6u, 100000u})
    all.push_back({[=](auto& info) { info.D.assign(length, 0.01), info.distortion_model = "equidistant"; },
                   "D holds " + std::to_string(length)});
  expectRefused(all);
}

TEST(Fault, M29_ModelsThatAreNone) {
  std::vector<Refusal> all;
  for (const std::string model : {"", "Equidistant", "Fisheye", "PLUMB_BOB", "division"})
    all.push_back({[=](auto& info) { info.distortion_model = model; },
                   "only plumb_bob, equidistant (fisheye) and rational_polynomial"});
  expectRefused(all);
}

CameraInfo fisheyeInfo() {
  CameraInfo info = test::sampleCameraInfo();
  info.distortion_model = "equidistant";
  info.D = {-0.02, 0.01, -0.004, 0.0007};
  info.K = {300.0, 0.0, 321.0, 0.0, 301.0, 238.0, 0.0, 0.0, 1.0};
  return info;
}

double worstAgainstOpenCv(const geometry::PinholeCamera& camera, const CameraInfo& info) {
  double worst = 0.0;
  for (double x = -2.0; x <= 2.0; x += 0.25)
    for (double y = -1.5; y <= 1.5; y += 0.25) {
      std::vector<cv::Point2d> pixel;
      cv::fisheye::projectPoints(std::vector<cv::Point3d>{{x, y, 1.0}}, pixel, cv::Vec3d(), cv::Vec3d(),
                                 cv::Matx33d(info.K.data()), cv::Vec4d(info.D.data()));
      const auto seen = camera.project({x, y, 1.0});
      EXPECT_TRUE(seen);
      if (!seen) continue;
      const Eigen::Vector2d expected(pixel[0].x, pixel[0].y);
      worst = std::max(worst, (*seen - expected).norm());
      const Eigen::Vector3d ray = camera.ray(*seen);
      EXPECT_LT((ray.head<2>() / ray.z() - Eigen::Vector2d(x, y)).norm(), 1e-9);
    }
  return worst;
}

// The image of this lens, computed from the image of an ideal camera with the same K.
cv::Mat bent(const cv::Mat& ideal, const geometry::PinholeCamera& camera) {
  cv::Mat map(ideal.size(), CV_32FC2), seen;
  for (int y = 0; y < map.rows; ++y)
    for (int x = 0; x < map.cols; ++x) {
      const Eigen::Vector2d from = camera.undistort(Eigen::Vector2d(x, y));
      map.at<cv::Vec2f>(y, x) = {static_cast<float>(from.x()), static_cast<float>(from.y())};
    }
  cv::remap(ideal, seen, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return seen;
}

TEST(Fault, M30_Fisheye) {
  const auto camera = cameraFromMsg(fisheyeInfo(), false);
  ASSERT_TRUE(camera) << camera.reason;
  EXPECT_LT(worstAgainstOpenCv(*camera.value, fisheyeInfo()), 1e-9);
  const auto again = cameraFromMsg(toMsg(*camera.value), false);
  ASSERT_TRUE(again) << again.reason;
  EXPECT_EQ(again.value->distortion, camera.value->distortion);
  EXPECT_EQ(again.value->model, geometry::LensModel::kEquidistant);

  const geometry::OpeningSize opening{1.2, 1.0};
  const Eigen::Isometry3d T =
      geometry::makePose(geometry::R_optical_flu() * geometry::yawRotation(0.3), {0.3, -0.2, 1.6});
  test::DrawnWindow drawn;
  drawn.opening = *geometry::projectOpening(camera.value->withoutDistortion(), T, opening);
  drawn.frame_px = 14.0;
  const auto window = detection::WindowDetector(detection::DetectorParams())
                          .detect(bent(drawn.draw(), *camera.value), 1.0, &*camera.value);
  ASSERT_TRUE(window);
  EXPECT_LT(test::worstCorner(window->corners, *geometry::projectOpening(*camera.value, T, opening)), 1.0);
  const auto pose =
      estimation::WindowPoseEstimator(estimation::PoseParams()).estimate(*window, *camera.value);
  ASSERT_TRUE(pose.estimate) << pose.detail;
  const double error_m = (pose.estimate->best.T_camera_window.translation() - T.translation()).norm();
  EXPECT_LT(error_m, 0.03);
  EXPECT_NEAR(pose.estimate->yaw_rad, 0.3, 0.03);
  RecordProperty("seen", "as OpenCV projects; window found in a fisheye image, pose off by " +
                             std::to_string(static_cast<int>(1000.0 * error_m)) + " mm");
}

TEST(Fault, M32_SizesThatAreNone) {
  std::vector<Refusal> all;
  for (const std::uint32_t side : {0u, 100000u, 4000000000u}) {
    all.push_back({[=](auto& info) { info.width = side; }, "is not within 1..20000"});
    all.push_back({[=](auto& info) { info.height = side; }, "is not within 1..20000"});
    all.push_back({[=](auto& info) { info.width = info.height = side; }, "is not within 1..20000"});
  }
  expectRefused(all);
}

// Position of a full-resolution pixel in the image as it is sent.
Eigen::Vector2d cropped(const Eigen::Vector2d& full, double x, double y, double binning) {
  return {(full.x() - x + 0.5) / binning - 0.5, (full.y() - y + 0.5) / binning - 0.5};
}

TEST(Fault, M33_BinningAndRegions) {
  const Eigen::Vector3d point(0.2, -0.1, 1.0);
  double worst = 0.0;
  for (const bool rectified : {false, true})
    for (const int binning : {0, 1, 2, 4})
      for (const bool region : {false, true}) {
        CameraInfo info = test::sampleCameraInfo();
        const Eigen::Vector2d full = *cameraFromMsg(info, rectified).value->project(point);
        info.binning_x = info.binning_y = binning;
        if (region)
          info.roi.x_offset = 100, info.roi.y_offset = 60, info.roi.width = 400, info.roi.height = 320;
        info.roi.do_rectify = region;
        const auto camera = cameraFromMsg(info, rectified);
        ASSERT_TRUE(camera) << camera.reason;
        const Eigen::Vector2d expected =
            cropped(full, region ? 100 : 0, region ? 60 : 0, std::max(1, binning));
        worst = std::max(worst, (*camera.value->project(point) - expected).norm());
      }
  EXPECT_LT(worst, 1e-9);
  expectRefused(
      {{[](auto& i) { i.binning_x = 4000000000u; }, "binning 4000000000x0 is above 16"},
       {[](auto& i) { i.binning_y = 17; }, "above 16"},
       {[](auto& i) { i.roi.x_offset = 600, i.roi.width = 100, i.roi.height = 100; }, "lies outside"},
       {[](auto& i) { i.roi.x_offset = 4294967295u, i.roi.width = 2, i.roi.height = 2; }, "lies outside"},
       {[](auto& i) { i.roi.y_offset = 5000, i.roi.width = 2, i.roi.height = 2; }, "lies outside"},
       {[](auto& i) { i.roi.width = 100; }, "lies outside"},
       {[](auto& i) { i.roi.width = 100, i.roi.height = 80; }, "do_rectify false", true}});
  RecordProperty("seen",
                 "exact with binning 1, 2, 4 and a region; binning 4e9 and regions off the image refused");
}

TEST(Fault, M36_CalibrationFiles) {
  const std::string good =
      "image_width: 640\nimage_height: 480\ncamera_name: front\n"
      "camera_matrix: {rows: 3, cols: 3, data: [554, 0, 319.5, 0, 553, 239.5, 0, 0, 1]}\n"
      "distortion_model: plumb_bob\n"
      "distortion_coefficients: {rows: 1, cols: 5, data: [-0.2, 0.05, 0.001, 0, 0]}\n";
  const std::string file = testing::TempDir() + "calibration_faults_test.yaml";
  const auto write = [&](const std::string& text) { std::ofstream(file) << text; };
  const auto with = [&](const std::string& what, const std::string& by) {
    std::string text = good;
    return text.replace(text.find(what), what.size(), by);
  };
  write(good);
  ASSERT_EQ(parameters::readCalibrationFile(file).fx, 554.0);
  std::vector<std::string> bad{"",
                               "\n",
                               "no mapping",
                               "\xff\xfe\x00",
                               with("640", "-640"),
                               with("640", ".nan"),
                               with("640", "1e11"),
                               with("554", ".nan"),
                               with("554", ".inf"),
                               with("554", "-554"),
                               with("-0.2", ".nan"),
                               with("rows: 3, cols: 3", "rows: 316228, cols: 316228"),
                               with("rows: 3, cols: 3", "rows: -3, cols: 3"),
                               with("rows: 1, cols: 5", "rows: 100000000000, cols: 1"),
                               with("camera_matrix", "matrix")};
  const std::string calibrated = good.substr(0, good.find("distortion_model"));
  for (std::size_t length = 1; length + 1 < calibrated.size(); ++length)  // cut off anywhere before the lens
    bad.push_back(good.substr(0, length));
  int refused = 0;
  for (const std::string& text : bad) {
    write(text);
    try {
      parameters::readCalibrationFile(file);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find(file), 0u) << error.what();
      ++refused;
    }
  }
  EXPECT_THROW(parameters::readCalibrationFile("/nowhere/camera.yaml"), InputError);
  EXPECT_THROW(parameters::readCalibrationFile(testing::TempDir()), InputError) << "a folder";
  RecordProperty("seen",
                 std::to_string(refused + 2) + " files refused by name; nothing but an exception comes back");
}

}  // namespace window_ingress::adapters::calibration_faults_test
