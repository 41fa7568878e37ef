#include "estimation/checks/mounting_check.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

#include "evaluation/poses/filter_survey.hpp"
#include "frame_faults.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation::mounting_check_test {

constexpr double kTurn = 10.0 * M_PI / 180.0;

struct Result {
  FramesVerdict::State state;
  std::string what;
  double way_m;  ///< path length until the verdict
};

/// The first wrong verdict, otherwise the last verdict. Drift, attitude errors and noise are always present.
Result fly(unsigned seed, const test::FrameFaults& faults, double larger = 1.0, double speed_mps = 0.6) {
  FilterParams errors;
  errors.mounting_yaw_sigma_rad = 0.005;  // `faults` adds the turn
  auto script = evaluation::drawApproach(seed, evaluation::SizeTold::kAll);
  script.opening.width_m *= larger;
  script.opening.height_m *= larger;
  script.image_rate_hz = 15.0;
  script.speed_mps = speed_mps;
  evaluation::SyntheticApproach approach(seed, script, errors);
  MountingCheck check({}, errors, {{1.2, 1.0}});
  while (approach.advance()) {
    if (approach.isInView())
      check.see(approach.window(), approach.camera(), faults.reported(approach.odometry().back()).T_odom_base,
                faults.T_base_camera(approach));
    if (check.verdict().state == FramesVerdict::kWrong) break;
  }
  return {check.verdict().state, check.verdict().what, approach.flownM()};
}

TEST(MountingCheck, NoFalseAlarmInTwoHundredApproachesThatAreAsSaid) {
  int good = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Result result = fly(seed, {});
    EXPECT_NE(result.state, FramesVerdict::kWrong) << seed << ": " << result.what;
    good += result.state == FramesVerdict::kGood;
  }
  EXPECT_GE(good, 195);
}

void expectFound(const test::FrameFaults& faults, const std::string& name, double within_m) {
  double furthest = 0.0;
  for (unsigned seed = 300; seed < 320; ++seed) {
    const Result result = fly(seed, faults);
    EXPECT_EQ(result.state, FramesVerdict::kWrong) << seed;
    EXPECT_NE(result.what.find(name), std::string::npos) << seed << ": " << result.what;
    furthest = std::max(furthest, result.way_m);
  }
  EXPECT_LT(furthest, within_m);
  std::printf("%s: found within %.1f m of way\n", name.c_str(), furthest);
}

TEST(MountingCheck, FindsAndNamesACameraTurnedByTenDegrees) {
  test::FrameFaults roll, pitch, yaw;
  roll.mounting_rad.x() = -kTurn;
  pitch.mounting_rad.y() = kTurn;
  yaw.mounting_rad.z() = kTurn;
  expectFound(roll, "in roll", 1.5);
  expectFound(pitch, "in pitch", 1.5);
  expectFound(yaw, "in yaw", 4.0);
}

TEST(MountingCheck, SaysWhichWayTheCameraIsTurned) {
  for (const double sign : {-1.0, 1.0}) {
    test::FrameFaults faults;
    faults.mounting_rad.z() = sign * 2.0 * kTurn;
    const Result result = fly(7, faults);
    const bool says_minus = result.what.find("about -") != std::string::npos;
    EXPECT_EQ(says_minus, sign < 0.0) << result.what;
  }
}

TEST(MountingCheck, FindsAndNamesAxesThatAreOthers) {
  test::FrameFaults optical, left, behind;
  optical.mounting_axes = "optical";
  left.mounting_axes = "left";
  behind.mounting_axes = "behind";
  expectFound(optical, "not optical ones", 3.0);
  expectFound(left, "about -90 deg in yaw", 3.0);
  expectFound(behind, "180 deg in yaw", 3.0);
}

TEST(MountingCheck, FindsMostPositionsWithExchangedAxes) {
  int found = 0;
  for (unsigned seed = 300; seed < 320; ++seed) {
    test::FrameFaults faults;
    faults.mirrored_odometry = true;
    found += fly(seed, faults).state == FramesVerdict::kWrong;
  }
  EXPECT_GE(found, 18) << "of 20; a way along the diagonal is its own mirror image";
}

TEST(MountingCheck, FindsASizeThatIsWrongByAFifthHoweverSlowly) {
  for (const double speed_mps : {0.25, 0.4, 0.6, 1.0}) {
    int found = 0;
    for (unsigned seed = 300; seed < 320; ++seed) {
      const Result result = fly(seed, {}, 1.2, speed_mps);
      found += result.what.find("configured as 1.20 x 1.00") != std::string::npos;
      EXPECT_NE(fly(seed, {}, 1.0, speed_mps).state, FramesVerdict::kWrong) << seed << " at " << speed_mps;
    }
    std::printf("a size wrong by a fifth: found in %d of 20 at %.2f m/s\n", found, speed_mps);
    EXPECT_GE(found, 19) << "of 20";
  }
}

TEST(MountingCheck, BadInputIsIgnored) {
  MountingCheck check({}, FilterParams(), {{1.2, 1.0}});
  const auto camera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);
  const auto T = geometry::makePose(Eigen::Matrix3d::Identity(), {0, 0, 1});
  auto bad = T;
  bad.translation().x() = std::numeric_limits<double>::quiet_NaN();
  detection::WindowObservation window;
  for (int i = 0; i < 50; ++i) {
    window.stamp_sec = i;
    check.see(window, camera, T, T);
    check.see(window, camera, bad, T);
    check.see(window, camera, T, bad);
    check.see(window, {}, T, T);
  }
  EXPECT_EQ(check.verdict().state, FramesVerdict::kUndecided);
  EXPECT_FALSE(check.measuredSize());
}

}  // namespace window_ingress::estimation::mounting_check_test
