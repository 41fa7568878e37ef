#include "window_ingress/navigation/camera_in_body.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation::camera_in_body_test {

// A camera pitched down by `pitch_rad`, turned to the left by `yaw_rad`, 0.3 m ahead.
Eigen::Isometry3d mounted(double pitch_rad, double yaw_rad) {
  const Eigen::Matrix3d R_base_link = (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                                       Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()))
                                          .toRotationMatrix();
  return geometry::makePose(R_base_link * geometry::R_optical_flu().transpose(), Eigen::Vector3d(0.3, 0, 0));
}

geometry::PinholeCamera camera() { return geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2); }

TEST(CameraInBody, LookingAheadSeesTheFieldOfViewOfItsCalibration) {
  const CameraInBody seen = cameraInBody(camera(), mounted(0.0, 0.0));
  EXPECT_DOUBLE_EQ(seen.forward_m, 0.3);
  EXPECT_NEAR(seen.horizontal_fov_rad, 1.2, 1e-12);
  EXPECT_NEAR(seen.vertical_fov_rad, 2.0 * std::atan(0.75 * std::tan(0.6)), 1e-12);
  EXPECT_DOUBLE_EQ(seen.pixel_rad, 1.0 / camera().fx);
  EXPECT_EQ(faultOf(seen), "");
}

TEST(CameraInBody, TurnedAsideItSeesLessByTwiceTheAngle) {
  const CameraInBody ahead = cameraInBody(camera(), mounted(0.0, 0.0));
  for (const double angle_rad : {-0.1, 0.1}) {
    EXPECT_NEAR(cameraInBody(camera(), mounted(0.0, angle_rad)).horizontal_fov_rad,
                ahead.horizontal_fov_rad - 0.2, 1e-9);
    EXPECT_NEAR(cameraInBody(camera(), mounted(angle_rad, 0.0)).vertical_fov_rad,
                ahead.vertical_fov_rad - 0.2, 1e-9);
  }
}

TEST(CameraInBody, SitsInTheBodyAndLooksForward) {
  VehicleParams vehicle;  // extends 0.25 m ahead and aside, 0.12 m up
  const auto why = [&](const Eigen::Vector3d& at_m, double pitch_rad = 0.0, double yaw_rad = 0.0) {
    return whyNotMounted(geometry::makePose(mounted(pitch_rad, yaw_rad).linear(), at_m), vehicle);
  };
  EXPECT_EQ(why({0.25, -0.25, 0.12}), "");
  EXPECT_EQ(why({0.1, 0.0, 0.0}, 0.5, 0.3), "");
  for (const Eigen::Vector3d& at_m : {Eigen::Vector3d(0.3, 0, 0), {0.1, -0.5, 0}, {0.1, 0, 0.2}})
    EXPECT_NE(why(at_m).find("lies outside of the vehicle"), std::string::npos) << at_m.transpose();
  vehicle.half_width_m = 0.5;
  EXPECT_EQ(why({0.1, -0.5, 0.0}), "");
  EXPECT_NE(why({0.1, 0.0, 0.0}, 2.0).find("does not look forward"), std::string::npos);
  EXPECT_NE(why({0.1, 0.0, 0.0}, 0.0, M_PI).find("does not look forward"), std::string::npos);
  EXPECT_NE(why({0.1, 0.0, 0.0}, std::nan("")).find("does not look forward"), std::string::npos);
}

TEST(CameraInBody, APrincipalPointAsideSeesLessToThatSide) {
  auto aside = camera();
  aside.cx -= 40.0;
  EXPECT_NEAR(cameraInBody(aside, mounted(0.0, 0.0)).horizontal_fov_rad,
              2.0 * std::atan((320.0 - 40.0) / aside.fx), 1e-9);
}

TEST(CameraInBody, AFisheyeIsTakenToSeeNoMoreThanParametersMaySay) {
  geometry::PinholeCamera fisheye;
  fisheye.width = fisheye.height = 1000;
  fisheye.fx = fisheye.fy = 250.0;
  fisheye.cx = fisheye.cy = 499.5;
  fisheye.model = geometry::LensModel::kEquidistant;
  const CameraInBody seen = cameraInBody(fisheye, mounted(0.0, 0.0));
  EXPECT_DOUBLE_EQ(seen.horizontal_fov_rad, 2.8);
  EXPECT_EQ(faultOf(seen), "");
}

TEST(CameraInBody, WhatNobodyCanFlyByIsNamed) {
  EXPECT_NE(faultOf(cameraInBody(camera(), mounted(0.0, 1.57))).find("horizontal_fov_rad"),
            std::string::npos);
  EXPECT_NE(faultOf(cameraInBody(camera(), mounted(1.57, 0.0))).find("vertical_fov_rad"), std::string::npos);
  CameraInBody odd = cameraInBody(camera(), mounted(0.0, 0.0));
  odd.forward_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(faultOf(odd).find("camera_forward_m"), std::string::npos);
}

}  // namespace window_ingress::navigation::camera_in_body_test
