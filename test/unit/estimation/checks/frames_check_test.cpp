#include "estimation/checks/frames_check.hpp"

#include <gtest/gtest.h>

#include "evaluation/poses/filter_survey.hpp"

namespace window_ingress::estimation::frames_check_test {

FramesVerdict fly(unsigned seed, const evaluation::FrameFaults& faults, double* way_m = nullptr) {
  auto script = evaluation::drawApproach(seed, evaluation::SizeTold::kAll);
  script.image_rate_hz = 15.0;
  evaluation::SyntheticApproach approach(seed, script, FilterParams(), faults);
  FramesCheck check{MountingCheck({}, FilterParams(), {{1.2, 1.0}})};
  while (approach.advance() && check.verdict().state != FramesVerdict::kWrong) {
    for (const auto& odometry : approach.odometry())
      check.twist.add(odometry.stamp_sec, odometry.T_odom_base, odometry.velocity_odom_mps);
    if (approach.isInView())
      check.mounting.see(approach.window(), approach.camera(), approach.odometry().back().T_odom_base,
                         approach.T_base_camera());
  }
  if (way_m) *way_m = approach.flownM();
  return check.verdict();
}

TEST(FramesCheck, IsGoodWhereBothAreAndSaysNothingMore) {
  int good = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const auto verdict = fly(seed, {});
    EXPECT_NE(verdict.state, FramesVerdict::kWrong) << verdict.what;
    good += verdict == FramesVerdict{FramesVerdict::kGood, ""};
  }
  EXPECT_GE(good, 38);
}

TEST(FramesCheck, NamesTheTwistsFrameWithinTwoMetres) {
  evaluation::FrameFaults ned;
  ned.twist = "ned";
  for (unsigned seed = 1; seed <= 40; ++seed) {
    double way_m = 0.0;
    const auto verdict = fly(seed, ned, &way_m);
    EXPECT_EQ(verdict.state, FramesVerdict::kWrong);
    EXPECT_NE(verdict.what.find("twist looks like"), std::string::npos) << verdict.what;
    EXPECT_LT(way_m, 2.0);
  }
}

TEST(FramesCheck, FindsATwistInWorldAxes) {
  evaluation::FrameFaults world;
  world.twist = "world";
  int found = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) found += fly(seed, world).state == FramesVerdict::kWrong;
  EXPECT_GE(found, 36) << "of 40 headings evenly drawn: near zero, world and body are the same";
}

TEST(FramesCheck, StartsOpenForgetsPlacesAndKeepsWhatItFound) {
  FramesCheck check{MountingCheck({}, FilterParams(), {{1.2, 1.0}})};
  EXPECT_EQ(check.verdict().state, FramesVerdict::kUndecided);
  EXPECT_NE(check.verdict().what.find("camera mounting"), std::string::npos);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 100; ++i, T.translation().x() += 0.02) check.twist.add(i / 50.0, T, {-1.0, 0, 0});
  EXPECT_EQ(check.verdict().state, FramesVerdict::kWrong);
  check.forgetPlaces();
  EXPECT_EQ(check.verdict().state, FramesVerdict::kWrong);
  check.clear();
  EXPECT_EQ(check.verdict().state, FramesVerdict::kUndecided);
}

}  // namespace window_ingress::estimation::frames_check_test
