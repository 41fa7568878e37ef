#include "adapters/pose/camera_mounting.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "refusal.hpp"

namespace window_ingress::adapters::camera_mounting_test {

using Eigen::Vector3d;

TEST(CameraMounting, OpticalAxesInTheBody) {
  const double turn = 0.3, c = std::cos(turn), s = std::sin(turn);
  struct Case {
    double yaw, pitch, roll;
    Vector3d ahead, down;
  };
  const Case cases[] = {{0.0, 0.0, 0.0, {1, 0, 0}, {0, 0, -1}},
                        {turn, 0.0, 0.0, {c, s, 0}, {0, 0, -1}},
                        {0.0, turn, 0.0, {c, 0, -s}, {-s, 0, -c}},
                        {0.0, 0.0, turn, {1, 0, 0}, {0, s, -c}}};
  for (const Case& each : cases) {
    const auto T_base_camera = T_base_cameraOf({0.1, 0.2, 0.3, each.yaw, each.pitch, each.roll});
    EXPECT_TRUE(T_base_camera.translation().isApprox(Vector3d(0.1, 0.2, 0.3)));
    EXPECT_TRUE((T_base_camera.linear() * Vector3d::UnitZ()).isApprox(each.ahead, 1e-12));
    EXPECT_TRUE((T_base_camera.linear() * Vector3d::UnitY()).isApprox(each.down, 1e-12));
  }
}

TEST(CameraMounting, RefusesDegreesAndWhatLiesBesideASmallVehicle) {
  EXPECT_THROW(T_base_cameraOf({0.1, 0, 0, 15.0, 0, 0}), InputError);
  EXPECT_THROW(T_base_cameraOf({0.1, 0, 0, 0, -4.0, 0}), InputError);
  EXPECT_THROW(T_base_cameraOf({100.0, 0, 0, 0, 0, 0}), InputError);
  EXPECT_NO_THROW(T_base_cameraOf({0.1, -0.2, 0.3, 3.14159265, -3.14159265, 0.0}));
}

TEST(CameraMounting, RefusesWhatIsNotSixNumbersWithTheirMeaning) {
  for (const auto& pose : {std::vector<double>{}, {0.1, 0.0, 0.0}, {0, 0, 0, 0, 0, 0, 0}})
    EXPECT_TRUE(test::says(test::refusalOf([&] { T_base_cameraOf(pose); }), "[x, y, z, yaw, pitch, roll]"));
}

}  // namespace window_ingress::adapters::camera_mounting_test
