#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "drawn_window.hpp"
#include "window_ingress/detection/window_tracker.hpp"

namespace window_ingress::detection::track_loss_test {

const geometry::PinholeCamera kCamera = geometry::PinholeCamera::fromFieldOfView(320, 240, 1.2);

test::DrawnWindow windowOf(int frame) {
  test::DrawnWindow drawn;
  drawn.width = 320, drawn.height = 240;
  drawn.opening = test::rectangle(100, 80, 196, 160);
  drawn.frame_px = 8.0;
  drawn.seed = 1 + frame;
  return drawn;
}

// A wrong attitude predicts the window elsewhere. The search finds the window in its old place.
TEST(TrackLoss, ALoopOfMixedBordersThatLiesNearerToAWrongPredictionIsNotTaken) {
  for (double wrong_rad = 0.124; wrong_rad < 0.15; wrong_rad += 0.004) {
    WindowTracker tracker{DetectorParams()};
    tracker.setReference({windowOf(100).draw(), windowOf(100).opening});
    for (int i = 0; i < 14; ++i) {
      TrackInput input;
      input.image = windowOf(i).draw();
      input.stamp_sec = 10.0 + i / 30.0;
      input.camera = &kCamera;
      input.R_world_camera =
          Eigen::AngleAxisd(i < 10 ? 0.0 : wrong_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
      const auto window = tracker.update(input);
      if (window && window->whole()) {
        EXPECT_LT(test::worstCorner(window->corners, windowOf(i).opening), 1.0) << i << ", " << wrong_rad;
      }
    }
  }
}

}  // namespace window_ingress::detection::track_loss_test
