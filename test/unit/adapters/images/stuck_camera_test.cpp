#include "adapters/images/stuck_camera.hpp"

#include <gtest/gtest.h>

namespace window_ingress::adapters::stuck_camera_test {

TEST(StuckCamera, IsOneWhoseImagesStayTheSame) {
  StuckCamera camera;
  cv::Mat image(60, 80, CV_8UC1);
  for (int x = 0; x < image.cols; ++x) image.col(x) = x;
  EXPECT_FALSE(camera.isStuck(image, 10.0));
  EXPECT_FALSE(camera.isStuck(image.clone(), 10.0 + StuckCamera::kStuckSec));
  EXPECT_TRUE(camera.isStuck(image.clone(), 10.1 + StuckCamera::kStuckSec));
  image += cv::Scalar::all(1);
  EXPECT_FALSE(camera.isStuck(image, 12.0));
  EXPECT_FALSE(camera.isStuck(image.colRange(0, 40), 13.5)) << "another size is another image";
  EXPECT_FALSE(camera.isStuck(cv::Mat(1, 1, CV_8UC1, cv::Scalar(0)), 15.0));
}

}  // namespace window_ingress::adapters::stuck_camera_test
