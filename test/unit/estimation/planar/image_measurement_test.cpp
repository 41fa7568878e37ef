#include "estimation/planar/image_measurement.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "../pose_fixtures.hpp"

namespace window_ingress::estimation::image_measurement_test {

using namespace fixtures;

TEST(ImageMeasurement, ImagesFromOnePlaceWeighNoMoreThanTheirSharedError) {
  const double white = 0.04, systematic = 0.0225;
  double information = 0.0;
  for (int k = 1; k <= 1000; ++k) {
    ImageNoise noise;
    noise.looks = k;
    information += 1.0 / marginalVariance(white, systematic, noise);
    EXPECT_NEAR(1.0 / information, white / k + systematic, 1e-9);
  }
  ImageNoise capped;
  capped.looks = 1e6;
  capped.max_looks_variance = 100.0;
  EXPECT_NEAR(marginalVariance(white, systematic, capped), 100.0 * systematic, 1e-12);
}

TEST(ImageMeasurement, ResidualsOfTheTrueViewHaveUnitVariance) {
  std::mt19937 random(1);
  ImageNoise noise;
  noise.systematic_sigma_px = 1e-4;
  const auto T = view(4.0, 0.4, 0.3, 0.2);
  const CornerVector truth = predictOpening(distortedCamera(), T, kOpening)->corners_px;
  Eigen::Matrix<double, 8, 1> squares = Eigen::Matrix<double, 8, 1>::Zero();
  const int draws = 4000;
  for (int i = 0; i < draws; ++i) {
    const auto window = bordersSeen(distortedCamera(), T, 1.0, random);
    const auto image = ImageMeasurement::make(window, distortedCamera(), noise);
    ASSERT_TRUE(image);
    squares += image->evaluate(truth).residual.cwiseAbs2() / draws;
  }
  // Borders that are straight in the distorted image approximate fits in the undistorted one.
  for (int k = 0; k < 8; ++k) EXPECT_NEAR(squares(k), 1.0, 0.15) << k;
}

// Both errors are in pixels of the distorted image. At 63 degrees off the axis ideal pixels are five times
// smaller.
TEST(ImageMeasurement, ErrorsOfAFisheyesImageAreItsPixels) {
  geometry::PinholeCamera fisheye = camera();
  fisheye.model = geometry::LensModel::kEquidistant;
  fisheye.fx = fisheye.fy = 320.0 / 1.309;
  const auto T = view(0.3, 0.0);
  const CornerVector truth = predictOpening(fisheye, T, kOpening)->corners_px;
  for (const double white_px : {0.5, 1e-3}) {
    ImageNoise noise;
    noise.systematic_sigma_px = white_px > 0.1 ? 1e-4 : 0.5 * std::sqrt(2.0);
    detection::WindowObservation window;
    window.corner_visible.fill(false);
    const double shift_px = 0.5, lens_off = truth(2);  // shift of the right side, outwards
    const Eigen::Vector2d middle = fisheye.distort({lens_off, fisheye.cy});
    const double seen = fisheye.undistort({middle.x() + shift_px, middle.y()}).x();
    window.edges[geometry::kRight] = {true, white_px, 0.01, fisheye.distort({seen, truth(3)}),
                                      fisheye.distort({seen, truth(5)})};
    const auto image = ImageMeasurement::make(window, fisheye, noise);
    ASSERT_TRUE(image);
    EXPECT_NEAR(std::abs(image->evaluate(truth).residual(0)), 1.0, 0.05) << white_px;
  }
}

TEST(ImageMeasurement, CornersAreUsedWhereBordersBringNothing) {
  auto window = cornersSeen(camera(), view(4.0, 0.4), 0.5);
  ImageNoise noise;
  noise.systematic_sigma_px = 1e-6;
  const auto image = ImageMeasurement::make(window, camera(), noise).value();
  CornerVector off = image.cornersPx();
  off(3) += 1.0;
  EXPECT_NEAR(image.evaluate(off).residual.norm(), 2.0, 1e-6);
  window.corner_covariance[1].setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_NEAR(ImageMeasurement::make(window, camera(), noise)->evaluate(off).residual.norm(), 1.0, 1e-6);
}

TEST(ImageMeasurement, RefusesNumbersThatAreNotFinite) {
  auto window = cornersSeen(camera(), view(4.0, 0.4), 0.5);
  window.corners[2].y() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(ImageMeasurement::make(window, camera(), {}));
  std::mt19937 random(1);
  auto flat = bordersSeen(camera(), view(4.0, 0.4), 0.5, random);
  flat.corners[1] = flat.corners[0];
  EXPECT_FALSE(ImageMeasurement::make(flat, camera(), {}));
}

}  // namespace window_ingress::estimation::image_measurement_test
