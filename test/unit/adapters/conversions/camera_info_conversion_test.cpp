#include <gtest/gtest.h>

#include <limits>

#include "adapters/conversions/msg_conversion.hpp"
#include "sample_camera_info.hpp"

namespace window_ingress::adapters::camera_info_conversion_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

template <typename Change>
std::string refusal(Change change, bool rectified = false) {
  sensor_msgs::CameraInfo info = test::sampleCameraInfo();
  change(info);
  const auto camera = cameraFromMsg(info, rectified);
  EXPECT_EQ(camera.value.has_value(), camera.reason.empty());
  return camera.reason;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(CameraInfo, RawImagesTakeKAndD) {
  const auto camera = cameraFromMsg(test::sampleCameraInfo(), false);
  ASSERT_TRUE(camera) << camera.reason;
  EXPECT_EQ(camera.value->fx, 554.0);
  EXPECT_EQ(camera.value->fy, 553.0);
  EXPECT_EQ(camera.value->cx, 319.5);
  EXPECT_EQ(camera.value->cy, 239.5);
  EXPECT_EQ(camera.value->distortion[0], -0.2);
}

TEST(CameraInfo, RectifiedImagesTakePAndNoDistortion) {
  const auto camera = cameraFromMsg(test::sampleCameraInfo(), true);
  ASSERT_TRUE(camera) << camera.reason;
  EXPECT_EQ(camera.value->fx, 500.0);
  EXPECT_EQ(camera.value->cy, 240.0);
  EXPECT_FALSE(camera.value->hasDistortion());
}

TEST(CameraInfo, ZeroKIsUncalibrated) {
  EXPECT_TRUE(contains(refusal([](auto& info) { info.K.assign(0.0); }), "uncalibrated"));
}

TEST(CameraInfo, RefusesNumbersThatAreNotFinite) {
  for (const double bad : {kNan, kInf, -kInf}) {
    EXPECT_FALSE(refusal([&](auto& info) { info.K[0] = bad; }).empty());
    EXPECT_FALSE(refusal([&](auto& info) { info.D[2] = bad; }).empty());
    EXPECT_FALSE(refusal([&](auto& info) { info.R[4] = bad; }).empty());
    EXPECT_FALSE(refusal([&](auto& info) { info.P[3] = bad; }).empty());
  }
}

TEST(CameraInfo, RefusesFocalLengthsThatAreNotPositive) {
  EXPECT_FALSE(refusal([](auto& info) { info.K[0] = -554.0; }).empty());
  EXPECT_FALSE(refusal([](auto& info) { info.K[4] = 0.0; }).empty());
  EXPECT_FALSE(refusal([](auto& info) { info.P[0] = -1.0; }, true).empty());
}

TEST(CameraInfo, ZeroPServesRawImagesOnly) {
  EXPECT_TRUE(refusal([](auto& info) { info.P.assign(0.0); }).empty());
  EXPECT_TRUE(contains(refusal([](auto& info) { info.P.assign(0.0); }, true), "P is zero"));
}

TEST(CameraInfo, RefusesSizesBeforeAnyAllocation) {
  for (const std::uint32_t side : {0u, 100000u, 4000000000u}) {
    EXPECT_TRUE(contains(refusal([&](auto& info) { info.width = side; }), "size"));
    EXPECT_TRUE(contains(refusal([&](auto& info) { info.height = side; }), "size"));
  }
}

TEST(CameraInfo, RefusesDOfTheWrongLength) {
  for (const std::size_t length : {1u, 3u, 6u, 8u, 100000u})
    EXPECT_TRUE(contains(refusal([&](auto& info) { info.D.assign(length, 0.01); }), "D holds")) << length;
  EXPECT_TRUE(refusal([](auto& info) { info.D.clear(); }).empty()) << "no distortion given";
  EXPECT_TRUE(refusal([](auto& info) { info.D.resize(4); }).empty()) << "k3 is 0";
}

TEST(CameraInfo, RefusesUnknownModelsAndSaysWhichAreKnown) {
  for (const std::string model : {"Equidistant", "", "PLUMB_BOB", "division"})
    EXPECT_TRUE(contains(refusal([&](auto& info) { info.distortion_model = model; }), "plumb_bob")) << model;
  const auto without_numbers = [](auto& info) { info.distortion_model = "division", info.D.clear(); };
  EXPECT_TRUE(contains(refusal(without_numbers), "division"));
  EXPECT_TRUE(refusal([](auto& info) { info.distortion_model = "equidistant"; }, true).empty())
      << "rectified images have no model any more";
}

TEST(CameraInfo, TheWordFisheyeIsEquidistant) {
  sensor_msgs::CameraInfo info = test::sampleCameraInfo();
  info.distortion_model = "fisheye";
  info.D = {-0.02, 0.005, 0.001, -0.0002};
  const auto camera = cameraFromMsg(info, false);
  ASSERT_TRUE(camera) << camera.reason;
  EXPECT_EQ(camera.value->model, geometry::LensModel::kEquidistant);
  EXPECT_EQ(camera.value->distortion[3], -0.0002);
  EXPECT_EQ(toMsg(*camera.value).distortion_model, "equidistant") << "the word of sensor_msgs";
  EXPECT_TRUE(contains(refusal([](auto& i) { i.distortion_model = "fisheye"; }), "fisheye has 4"));
}

TEST(CameraInfo, RationalModelOnlyWithoutItsDenominator) {
  const auto rational = [](double k4) {
    return [k4](auto& info) {
      info.distortion_model = "rational_polynomial";
      info.D = {0.1, 0.0, 0.0, 0.0, 0.0, k4, 0.0, 0.0};
    };
  };
  EXPECT_TRUE(refusal(rational(0.0)).empty());
  EXPECT_TRUE(contains(refusal(rational(0.1)), "k4"));
}

TEST(CameraInfo, BinningHalvesFocalLengthAndKeepsPixelCentres) {
  sensor_msgs::CameraInfo info = test::sampleCameraInfo();
  info.binning_x = info.binning_y = 2;
  const auto camera = cameraFromMsg(info, false);
  ASSERT_TRUE(camera) << camera.reason;
  EXPECT_EQ(camera.value->fx, 277.0);
  EXPECT_EQ(camera.value->width, 320);
  EXPECT_DOUBLE_EQ(camera.value->cx, 159.5) << "centre of 640 pixels stays centre of 320";
  EXPECT_TRUE(contains(refusal([](auto& i) { i.binning_x = 4000000000u; }), "binning"));
}

TEST(CameraInfo, BinningZeroIsOne) {
  sensor_msgs::CameraInfo info = test::sampleCameraInfo();
  info.binning_x = info.binning_y = 1;
  EXPECT_EQ(cameraFromMsg(info, false).value->cx, cameraFromMsg(test::sampleCameraInfo(), false).value->cx);
}

TEST(CameraInfo, RegionMovesThePrincipalPoint) {
  sensor_msgs::CameraInfo info = test::sampleCameraInfo();
  info.roi.x_offset = 100;
  info.roi.y_offset = 50;
  info.roi.width = 320;
  info.roi.height = 240;
  const auto camera = cameraFromMsg(info, false);
  ASSERT_TRUE(camera) << camera.reason;
  EXPECT_EQ(camera.value->cx, 219.5);
  EXPECT_EQ(camera.value->cy, 189.5);
  EXPECT_EQ(camera.value->width, 320);
  EXPECT_FALSE(cameraFromMsg(info, true)) << "a raw region does not fit rectified images";
  info.roi.do_rectify = true;
  EXPECT_TRUE(cameraFromMsg(info, true));
}

TEST(CameraInfo, RefusesRegionsOffTheImage) {
  EXPECT_FALSE(refusal([](auto& info) {
                 info.roi.x_offset = 600, info.roi.width = 100, info.roi.height = 100;
               }).empty());
  EXPECT_FALSE(refusal([](auto& info) {
                 info.roi.x_offset = 4294967295u, info.roi.width = 2, info.roi.height = 2;
               }).empty());
  EXPECT_FALSE(refusal([](auto& info) { info.roi.width = 100; }).empty()) << "without height";
}

TEST(CameraInfo, GoesThereAndBack) {
  const auto camera = cameraFromMsg(test::sampleCameraInfo(), false);
  const auto again = cameraFromMsg(toMsg(*camera.value), false);
  ASSERT_TRUE(again) << again.reason;
  EXPECT_EQ(again.value->K(), camera.value->K());
  EXPECT_EQ(again.value->distortion, camera.value->distortion);
}

}  // namespace window_ingress::adapters::camera_info_conversion_test
