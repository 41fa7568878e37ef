#include "window_ingress/parameters/calibration_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "refusal.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::parameters::calibration_file_test {

const char* const kGood =
    "image_width: 640\nimage_height: 480\ncamera_name: front\n"
    "camera_matrix: {rows: 3, cols: 3, data: [554, 0, 319.5, 0, 553, 239.5, 0, 0, 1]}\n"
    "distortion_model: plumb_bob\n"
    "distortion_coefficients: {rows: 1, cols: 5, data: [-0.2, 0.05, 0.001, 0, 0]}\n";

std::string written(const std::string& text) {
  const std::string file = testing::TempDir() + "calibration_file_test.yaml";
  std::ofstream(file) << text;
  return file;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

void expectRefused(const std::string& file, const std::string& word) {
  const std::string text = test::refusalOf([&] { readCalibrationFile(file); });
  EXPECT_TRUE(test::says(text, file));
  EXPECT_TRUE(test::says(text, word));
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

TEST(CalibrationFile, ReadsWhatCameraInfoManagerWrites) {
  const auto camera = readCalibrationFile(written(kGood));
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.fy, 553.0);
  EXPECT_EQ(camera.cx, 319.5);
  EXPECT_EQ(camera.distortion[0], -0.2);
}

TEST(CalibrationFile, ReadsAFisheyeWithItsFourCoefficients) {
  const std::string model = replaced(kGood, "plumb_bob", "equidistant");
  const std::string four = replaced(replaced(model, "cols: 5", "cols: 4"), ", 0, 0]}\n", ", 0]}\n");
  const auto camera = readCalibrationFile(written(four));
  EXPECT_EQ(camera.model, geometry::LensModel::kEquidistant);
  EXPECT_EQ(camera.distortion[1], 0.05);
  expectRefused(written(model), "5 numbers, equidistant has 4");
}

TEST(CalibrationFile, TheWordFisheyeIsEquidistant) {
  const std::string model = replaced(kGood, "plumb_bob", "fisheye");
  const std::string four = replaced(replaced(model, "cols: 5", "cols: 4"), ", 0, 0]}\n", ", 0]}\n");
  const auto camera = readCalibrationFile(written(four));
  EXPECT_EQ(camera.model, geometry::LensModel::kEquidistant);
  EXPECT_EQ(camera.distortion[0], -0.2);
  expectRefused(written(model), "5 numbers, fisheye has 4");
}

TEST(CalibrationFile, RefusesWithFileAndReason) {
  expectRefused("/nowhere/camera.yaml", "cannot be read");
  expectRefused("/", "cannot be read");
  expectRefused(written(""), "not a yaml mapping");
  expectRefused(written("image_width: [1"), "not valid yaml");
  expectRefused(written(replaced(kGood, "image_width: 640", "image_width: wide")), "image_width");
  expectRefused(
      written(replaced(kGood, "[554, 0, 319.5, 0, 553, 239.5, 0, 0, 1]", "[0, 0, 0, 0, 0, 0, 0, 0, 0]")),
      "uncalibrated");
  expectRefused(written(replaced(kGood, "554, ", "")), "camera_matrix");
  expectRefused(written(replaced(kGood, "554", ".nan")), "finite");
  expectRefused(written(replaced(kGood, "plumb_bob", "division")), "division");
  expectRefused(written(replaced(kGood, "rows: 3, cols: 3", "rows: 316228, cols: 316228")),
                "rows times cols");
  expectRefused(written(replaced(kGood, ", 0.001, 0, 0", "")), "distortion_coefficients");
}

}  // namespace window_ingress::parameters::calibration_file_test
