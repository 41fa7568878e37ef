#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "adapters/conversions/msg_conversion.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters::motion_conversion_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kQuarterTurn = 1.57079632679489662;
const FrameNames kFrames;

nav_msgs::Odometry makeOdometry(double yaw_rad) {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(12.5);
  message.header.frame_id = "odom";
  message.child_frame_id = "base_link";
  message.pose.pose = toPoseMsg(geometry::makePose(geometry::yawRotation(yaw_rad), {1.0, 2.0, 3.0}));
  message.twist.twist.linear.x = 0.5;
  message.twist.twist.angular.x = 0.1;
  message.twist.twist.angular.y = 0.2;
  message.twist.twist.angular.z = 0.3;
  return message;
}

template <typename Change>
std::string odometryRefusal(Change change) {
  nav_msgs::Odometry message = makeOdometry(0.3);
  change(message);
  const auto vehicle = fromMsg(message, kFrames);
  EXPECT_EQ(vehicle.value.has_value(), vehicle.reason.empty());
  return vehicle.reason;
}

TEST(Odometry, TwistIsRotatedFromBaseToOdom) {
  const auto vehicle = fromMsg(makeOdometry(kQuarterTurn), kFrames);
  ASSERT_TRUE(vehicle) << vehicle.reason;
  EXPECT_TRUE(vehicle.value->velocity_odom_mps.isApprox(Eigen::Vector3d(0.0, 0.5, 0.0), 1e-12))
      << "forward at a heading of north is +y of odom";
  EXPECT_TRUE(vehicle.value->turn_odom_radps.isApprox(Eigen::Vector3d(-0.2, 0.1, 0.3), 1e-12));
  EXPECT_EQ(vehicle.value->stamp_sec, 12.5);
  EXPECT_EQ(vehicle.value->T_odom_base.translation(), Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST(Odometry, ATurnThatCannotBeIsAsIfItWereNotReported) {
  for (const double bad : {kNan, kInf, 1e6}) {
    nav_msgs::Odometry message = makeOdometry(0.3);
    message.twist.twist.angular.z = bad;
    const auto vehicle = fromMsg(message, kFrames);
    ASSERT_TRUE(vehicle) << vehicle.reason;
    EXPECT_EQ(vehicle.value->turn_odom_radps, Eigen::Vector3d(0, 0, 0)) << bad;
  }
}

TEST(Odometry, RefusesOtherFramesByName) {
  EXPECT_NE(odometryRefusal([](auto& m) { m.header.frame_id = "map"; }).find("'map'"), std::string::npos);
  EXPECT_NE(odometryRefusal([](auto& m) { m.child_frame_id = "body"; }).find("child_frame_id"),
            std::string::npos);
  EXPECT_FALSE(odometryRefusal([](auto& m) { m.child_frame_id.clear(); }).empty());
}

TEST(Odometry, RefusesBadNumbers) {
  for (const double bad : {kNan, kInf, 1e6}) {
    EXPECT_FALSE(odometryRefusal([&](auto& m) { m.pose.pose.position.y = bad; }).empty()) << bad;
    EXPECT_FALSE(odometryRefusal([&](auto& m) { m.twist.twist.linear.z = bad; }).empty()) << bad;
    EXPECT_FALSE(odometryRefusal([&](auto& m) { m.pose.pose.orientation.x = bad; }).empty()) << bad;
  }
  EXPECT_FALSE(odometryRefusal([](auto& m) { m.header.stamp = ros::Time(); }).empty());
}

TEST(Odometry, QuaternionIsNormalisedOrRefused) {
  EXPECT_FALSE(
      odometryRefusal([](auto& m) { m.pose.pose.orientation = geometry_msgs::Quaternion(); }).empty());
  nav_msgs::Odometry message = makeOdometry(0.3);
  message.pose.pose.orientation.w *= 1.005;
  message.pose.pose.orientation.z *= 1.005;
  const auto vehicle = fromMsg(message, kFrames);
  ASSERT_TRUE(vehicle) << vehicle.reason;
  EXPECT_TRUE(geometry::isValidPose(vehicle.value->T_odom_base));
  EXPECT_NEAR(geometry::yawOf(vehicle.value->T_odom_base.linear()), 0.3, 1e-12);
  message.pose.pose.orientation.w *= -1.0;  // the same rotation with the other sign
  message.pose.pose.orientation.z *= -1.0;
  EXPECT_NEAR(geometry::yawOf(fromMsg(message, kFrames).value->T_odom_base.linear()), 0.3, 1e-12);
}

TEST(Imu, AttitudeIsRefusedWhereThereIsNone) {
  sensor_msgs::Imu message;
  message.header.stamp = ros::Time(3);
  message.header.frame_id = kFrames.base;
  EXPECT_FALSE(fromMsg(message, kFrames.base)) << "a quaternion of zeros";
  message.orientation.w = 1.0;
  EXPECT_TRUE(fromMsg(message, kFrames.base)) << "zero covariance means unknown, not absent";
  message.orientation_covariance[0] = -1.0;
  EXPECT_FALSE(fromMsg(message, kFrames.base));
  message.orientation_covariance[0] = 0.0;
  message.orientation.y = kNan;
  EXPECT_FALSE(fromMsg(message, kFrames.base));
  message.orientation.y = 0.0;
  EXPECT_FALSE(fromMsg(message, "another_link"));
  message.header.stamp = ros::Time();
  EXPECT_FALSE(fromMsg(message, kFrames.base)) << "without a stamp";
}

TEST(Transform, RefusesWhatTf2Accepts) {
  geometry_msgs::Transform message;
  message.rotation.w = 1.0;
  EXPECT_TRUE(fromMsg(message));
  message.translation.x = kInf;
  EXPECT_FALSE(fromMsg(message));
  message.translation.x = 0.0;
  message.rotation.w = 0.0;
  EXPECT_FALSE(fromMsg(message));
}

TEST(Pose, GoesThereAndBack) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(number(random), number(random), number(random), 1.1).normalized();
    const Eigen::Vector3d position(number(random), number(random), number(random));
    const Eigen::Isometry3d pose = geometry::makePose(q.toRotationMatrix(), position);
    EXPECT_TRUE(fromMsg(toPoseMsg(pose)).value->isApprox(pose, 1e-12));
    EXPECT_TRUE(fromMsg(toTransformStampedMsg(pose, {}, "").transform).value->isApprox(pose, 1e-12));
  }
}

TEST(Pose, CovarianceIsRowMajor) {
  estimation::Matrix6d covariance = estimation::Matrix6d::Zero();
  covariance(0, 5) = 7.0;
  EXPECT_EQ(toMsg(Eigen::Isometry3d::Identity(), covariance).covariance[5], 7.0);
}

TEST(Setpoint, OdomAxesPassUnchanged) {
  const navigation::Setpoint setpoint{{0.1, -0.2, 0.3}, 0.4};
  const auto message = toTwistMsg(setpoint, kFrames, std::nullopt);
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(toEigen(message.twist.linear), setpoint.velocity_odom_mps);
  EXPECT_EQ(message.twist.angular.z, 0.4);
}

TEST(Setpoint, BaseAxesAreTheVehiclesOwn) {
  const navigation::Setpoint north{{0.0, 1.0, 0.0}, 0.2};
  const auto message = toTwistMsg(north, kFrames, geometry::yawRotation(kQuarterTurn));
  EXPECT_EQ(message.header.frame_id, "base_link");
  EXPECT_NEAR(message.twist.linear.x, 1.0, 1e-12) << "north is ahead of a vehicle that looks north";
  EXPECT_NEAR(message.twist.linear.y, 0.0, 1e-12);
  EXPECT_NEAR(message.twist.angular.z, 0.2, 1e-12);
}

TEST(Setpoint, ComesBackTheSameWhateverItsFrame) {
  const navigation::Setpoint setpoint{{0.1, -0.2, 0.3}, 0.4};
  const Eigen::Matrix3d R_odom_base =
      (Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()))
          .toRotationMatrix();
  for (const bool in_base : {false, true}) {
    const auto message =
        toTwistMsg(setpoint, kFrames, in_base ? std::make_optional(R_odom_base) : std::nullopt);
    const auto back = fromMsg(message, kFrames, R_odom_base);
    ASSERT_TRUE(back) << back.reason;
    EXPECT_TRUE(back.value->velocity_odom_mps.isApprox(setpoint.velocity_odom_mps, 1e-12));
    EXPECT_NEAR(back.value->yaw_rate_radps, setpoint.yaw_rate_radps, 1e-12);
  }
}

TEST(Setpoint, RefusesUnknownFramesAndBadNumbers) {
  geometry_msgs::TwistStamped message;
  const Eigen::Matrix3d level = Eigen::Matrix3d::Identity();
  EXPECT_FALSE(fromMsg(message, kFrames, level)) << "no frame named";
  message.header.frame_id = "odom";
  EXPECT_TRUE(fromMsg(message, kFrames, level));
  message.twist.angular.z = kNan;
  EXPECT_FALSE(fromMsg(message, kFrames, level));
}

}  // namespace window_ingress::adapters::motion_conversion_test
