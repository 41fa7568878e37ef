#include "detection/tracking/image_sequence.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

namespace window_ingress::detection::image_sequence_test {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kGap_sec = 0.5;

struct Images {
  cv::Mat image = cv::Mat::zeros(48, 64, CV_8UC1);
  geometry::PinholeCamera camera = geometry::PinholeCamera::fromFieldOfView(64, 48, 1.0);

  TrackInput at(double stamp_sec, const std::optional<Matrix3d>& attitude = std::nullopt) const {
    TrackInput input;
    input.image = image;
    input.stamp_sec = stamp_sec;
    input.camera = &camera;
    input.R_world_camera = attitude;
    return input;
  }
};

TEST(ImageSequence, ContinuesWhileTimeGoesOnAndTheCameraIsTheSame) {
  const Images images;
  ImageSequence sequence(kGap_sec);
  EXPECT_FALSE(sequence.take(images.at(1.0)));
  EXPECT_EQ(sequence.elapsedSec(), 0.0);
  EXPECT_TRUE(sequence.take(images.at(1.25)));
  EXPECT_NEAR(sequence.elapsedSec(), 0.25, 1e-12);
  EXPECT_FALSE(sequence.take(images.at(1.25))) << "no time went by";
  EXPECT_FALSE(sequence.take(images.at(1.0))) << "back in time";
  EXPECT_FALSE(sequence.take(images.at(1.0 + 2.0 * kGap_sec)));
  EXPECT_TRUE(sequence.take(images.at(1.1 + 2.0 * kGap_sec)));
  sequence.forget();
  EXPECT_FALSE(sequence.take(images.at(1.2 + 2.0 * kGap_sec)));
}

TEST(ImageSequence, TellsAttitudesThatJitterFromAVehicleThatTurns) {
  for (const double noise_rad : {0.0, 0.002, 0.009}) {
    const Images images;
    ImageSequence sequence(kGap_sec);
    std::mt19937 random(4);
    std::normal_distribution<double> noise(0.0, 1.0);
    for (int i = 0; i < 200; ++i) {
      const double t = 0.05 * i;
      Matrix3d R = Eigen::AngleAxisd(0.4 * std::sin(1.5 * t), Vector3d::UnitZ()).toRotationMatrix();
      for (int axis = 0; axis < 3; ++axis)
        R = R * Eigen::AngleAxisd(noise_rad * noise(random), Vector3d::Unit(axis)).toRotationMatrix();
      sequence.take(images.at(t, R));
    }
    const double expected_px = std::sqrt(2.0) * noise_rad * images.camera.fx;
    EXPECT_NEAR(sequence.turnSigmaPx(), expected_px, 0.3 * expected_px + 0.08);
    sequence.take(images.at(1000.0));
    EXPECT_FALSE(sequence.turn());
  }
}

TEST(ImageSequence, WhatIsNoRotationIsNoAttitudeAndLeavesNothingBehind) {
  const Images images;
  const Matrix3d level = Matrix3d::Identity();
  ImageSequence sequence(kGap_sec);
  sequence.take(images.at(0.0, level));
  int i = 1;
  for (const Matrix3d& bad :
       {Matrix3d::Zero().eval(), Matrix3d::Constant(1e200).eval(), (2.0 * level).eval(), (-level).eval()}) {
    sequence.take(images.at(0.1 * i++, bad));
    EXPECT_FALSE(sequence.turn().has_value());
    sequence.take(images.at(0.1 * i++, level));
  }
  sequence.take(images.at(0.1 * i++, level));
  sequence.take(images.at(0.1 * i++, level));
  EXPECT_TRUE(sequence.turn().has_value());
  EXPECT_EQ(sequence.turnSigmaPx(), 0.0);
}

TEST(ImageSequence, AnotherSizeOrCalibrationBeginsAnew) {
  Images images;
  ImageSequence sequence(kGap_sec);
  sequence.take(images.at(1.0));
  images.camera.fx += 1.0;
  EXPECT_FALSE(sequence.take(images.at(1.1)));
  images.image = cv::Mat::zeros(50, 64, CV_8UC1);
  EXPECT_FALSE(sequence.take(images.at(1.2)));
  TrackInput input = images.at(1.3);
  input.camera = nullptr;
  EXPECT_FALSE(sequence.take(input));
  EXPECT_EQ(sequence.lens(), nullptr);
}

TEST(ImageSequence, TheTurnMovesWhatIsFarAwayToWhereItIsSeen) {
  const Images images;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-0.1, 0.1);
  ImageSequence sequence(kGap_sec);
  Matrix3d before = Matrix3d::Identity();
  sequence.take(images.at(0.0, before));
  for (int i = 1; i < 50; ++i) {
    const Vector3d rotation(angle(random), angle(random), angle(random));
    const Matrix3d now =
        before * Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
    ASSERT_TRUE(sequence.take(images.at(0.1 * i, now)));
    ASSERT_TRUE(sequence.turn().has_value());
    const Vector3d far = before * Vector3d(angle(random), angle(random), 1.0);
    const Vector3d seen_before = images.camera.K() * (before.transpose() * far);
    const Vector3d seen_now = images.camera.K() * (now.transpose() * far);
    const Vector3d moved = *sequence.turn() * seen_before;
    EXPECT_LT((moved.hnormalized() - seen_now.hnormalized()).norm(), 1e-9);
    before = now;
  }
}

TEST(ImageSequence, NoTurnWithoutTwoAttitudesInARow) {
  const Images images;
  const Matrix3d level = Matrix3d::Identity();
  const Matrix3d bad = Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  ImageSequence sequence(kGap_sec);
  sequence.take(images.at(0.0, level));
  EXPECT_FALSE(sequence.turn().has_value());
  sequence.take(images.at(0.1, bad));
  EXPECT_FALSE(sequence.turn().has_value());
  sequence.take(images.at(0.2, level));
  EXPECT_FALSE(sequence.turn().has_value()) << "the one before was no attitude";
  sequence.take(images.at(0.3, level));
  EXPECT_TRUE(sequence.turn().has_value());
  sequence.take(images.at(0.4));
  sequence.take(images.at(0.5, level));
  EXPECT_FALSE(sequence.turn().has_value());
  sequence.take(images.at(0.1, level));
  EXPECT_FALSE(sequence.turn().has_value()) << "back in time";
}

}  // namespace window_ingress::detection::image_sequence_test
