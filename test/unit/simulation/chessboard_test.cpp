// The chessboard of config/scenarios/chessboard.yaml: OpenCV finds the board, and calibration recovers the
// lens.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "simulation/scenario/scenario.hpp"
#include "simulation/scene/scene.hpp"
#include "view.hpp"

namespace window_ingress::simulation::chessboard_test {

const cv::Size kCorners(8, 6);
constexpr double kSquare_m = 0.1;

Scenario board() {
  return loadScenario(std::string(WINDOW_INGRESS_SOURCE_DIR) + "/config/scenarios/chessboard.yaml", 1);
}

std::vector<cv::Point3f> drawnCorners() {
  std::vector<cv::Point3f> corners;
  for (int row = 0; row < kCorners.height; ++row)
    for (int column = 0; column < kCorners.width; ++column)
      corners.emplace_back(static_cast<float>(kSquare_m * column), static_cast<float>(kSquare_m * row), 0.0f);
  return corners;
}

bool findCorners(const cv::Mat& image, std::vector<cv::Point2f>& corners) {
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  if (!cv::findChessboardCorners(grey, kCorners, corners)) return false;
  cv::cornerSubPix(grey, corners, {5, 5}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 30, 0.01});
  return true;
}

TEST(Chessboard, GivesTheLensBack) {
  const geometry::PinholeCamera lens = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);
  Renderer renderer(buildScene(board()), lens);
  std::vector<std::vector<cv::Point2f>> seen;
  cv::Mat image;
  for (const double y : {-1.0, 0.0, 1.0})
    for (const double z : {-0.6, 0.1, 0.7}) {
      renderer.render(views::lookAt({-1.4, y, z}, {0.0, 0.1 * y, 0.1 * z}), image);
      std::vector<cv::Point2f> corners;
      ASSERT_TRUE(findCorners(image, corners)) << y << " " << z;
      seen.push_back(corners);
    }
  const std::vector<std::vector<cv::Point3f>> drawn(seen.size(), drawnCorners());
  cv::Matx33d K;
  std::vector<double> distortion;
  std::vector<cv::Mat> turns, places;
  EXPECT_LT(cv::calibrateCamera(drawn, seen, image.size(), K, distortion, turns, places, cv::CALIB_FIX_K3),
            0.1);
  EXPECT_NEAR(K(0, 0), lens.fx, 0.003 * lens.fx);
  EXPECT_NEAR(K(1, 1), lens.fy, 0.003 * lens.fy);
  EXPECT_NEAR(K(0, 2), lens.cx, 1.5);
  EXPECT_NEAR(K(1, 2), lens.cy, 1.5);
}

TEST(Chessboard, APictureOfAnotherKindIsNone) {
  Scenario scenario = board();
  scenario.posters.at(0).look = "picture";
  std::vector<cv::Point2f> corners;
  EXPECT_FALSE(
      findCorners(views::photograph(buildScene(scenario), views::lookAt({-1.4, 0, 0}, {0, 0, 0})), corners));
  scenario.posters.at(0).look = "chessboard";
  EXPECT_TRUE(
      findCorners(views::photograph(buildScene(scenario), views::lookAt({-1.4, 0, 0}, {0, 0, 0})), corners));
}

}  // namespace window_ingress::simulation::chessboard_test
