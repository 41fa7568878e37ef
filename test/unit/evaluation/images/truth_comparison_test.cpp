#include "evaluation/images/truth_comparison.hpp"

#include <gtest/gtest.h>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::evaluation::truth_comparison_test {

const geometry::OpeningSize kOpening{1.2, 1.0};
const geometry::PinholeCamera kCamera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);

Eigen::Isometry3d poseAt(double distance_m, double yaw_rad) {
  return geometry::makePose(geometry::R_optical_flu() * geometry::yawRotation(yaw_rad),
                            {0.0, 0.0, distance_m});
}

detection::WindowObservation seen(const Eigen::Isometry3d& T_camera_window) {
  detection::WindowObservation window;
  window.corners = *geometry::projectOpening(kCamera, T_camera_window, kOpening);
  return window;
}

TEST(TruthComparison, PerfectEstimateHasNoError) {
  const Eigen::Isometry3d truth = poseAt(4.0, 0.3);
  const TruthErrors errors = compareWithTruth(seen(truth), truth, truth, kCamera, kOpening);
  EXPECT_TRUE(errors.whole);
  EXPECT_NEAR(errors.iou, 1.0, 1e-9);
  EXPECT_NEAR(errors.true_yaw_rad, 0.3, 1e-12);
  EXPECT_NEAR(errors.true_distance_m, 4.0, 1e-12);
  EXPECT_NEAR(*errors.yaw_rad, 0.0, 1e-12);
  EXPECT_NEAR(*errors.distance_m, 0.0, 1e-12);
}

TEST(TruthComparison, SignedErrorsOfAWrongEstimate) {
  const TruthErrors errors =
      compareWithTruth(seen(poseAt(4.0, 0.3)), poseAt(4.2, -0.3), poseAt(4.0, 0.3), kCamera, kOpening);
  EXPECT_NEAR(*errors.yaw_rad, -0.6, 1e-12);
  EXPECT_NEAR(*errors.distance_m, 0.2, 1e-12);
}

TEST(TruthComparison, TooCloseFromBehindOrOutOfViewIsNotWhole) {
  const auto whole = [](const Eigen::Isometry3d& truth) {
    return compareWithTruth(std::nullopt, std::nullopt, truth, kCamera, kOpening).whole;
  };
  EXPECT_TRUE(whole(poseAt(3.0, 0.0)));
  EXPECT_FALSE(whole(poseAt(0.5, 0.0)));
  EXPECT_FALSE(whole(poseAt(4.0, 3.0))) << "seen from inside";
  EXPECT_FALSE(whole(poseAt(-4.0, 0.0)));
}

TEST(TruthComparison, SummaryCountsFoundMissedAndOthers) {
  TruthSummary summary;
  const Eigen::Isometry3d truth = poseAt(4.0, 0.1);
  summary.add(compareWithTruth(seen(truth), poseAt(4.1, 0.12), truth, kCamera, kOpening));
  summary.add(compareWithTruth(std::nullopt, std::nullopt, truth, kCamera, kOpening));
  detection::WindowObservation decoy = seen(truth);
  for (auto& corner : decoy.corners) corner.x() += 250.0;
  summary.add(compareWithTruth(decoy, std::nullopt, truth, kCamera, kOpening));
  summary.add(compareWithTruth(std::nullopt, std::nullopt, poseAt(0.5, 0.0), kCamera, kOpening));
  EXPECT_EQ(summary.images, 4);
  EXPECT_EQ(summary.whole, 3);
  EXPECT_EQ(summary.found, 1);
  EXPECT_EQ(summary.exchanged, 1);
  ASSERT_EQ(summary.yaw_errors_rad.size(), 1u);
  EXPECT_NEAR(summary.yaw_errors_rad[0], 0.02, 1e-9);
  EXPECT_NE(summary.text().find("found in 1 (33.3 %)"), std::string::npos) << summary.text();
}

TEST(TruthComparison, EmptySummaryGivesNoErrorsButSaysWhatMayBeWrong) {
  TruthSummary summary;
  EXPECT_NE(summary.text().find("found in 0 (0.0 %)"), std::string::npos);
  EXPECT_EQ(summary.text().find("RMS"), std::string::npos);
  EXPECT_EQ(summary.text().find("median"), std::string::npos);
  EXPECT_EQ(summary.text().find("do camera_info"), std::string::npos);
  summary.exchanged = 192;
  EXPECT_NE(summary.text().find("do camera_info and the truth belong to these images?"), std::string::npos);
}

}  // namespace window_ingress::evaluation::truth_comparison_test
