#include "simulation/sensors/faults.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "refusal.hpp"
#include "simulation/world.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation::faults_test {

constexpr double kAtSec = 0.4, kEndSec = 0.8, kOverSec = 1.2;

FaultParams fault(const std::string& unit, const std::string& kind) {
  FaultParams params;
  params.unit = unit;
  params.kind = kind;
  params.at_sec = kAtSec;
  params.duration_sec = kEndSec - kAtSec;
  params.rate_hz = 5.0;
  params.delay_sec = params.off_sec = params.on_sec = 0.1;
  return params;
}

Scenario scenarioWith(const std::vector<FaultParams>& faults) {
  Scenario scenario;
  scenario.camera.width_px = 80;
  scenario.camera.height_px = 60;
  scenario.faults = faults;
  return scenario;
}

struct Recording {
  std::vector<CameraFrame> frames;
  std::vector<double> frame_at_sec, clock;
  std::vector<OdometrySample> odometry, transforms;
  std::vector<ImuSample> imu;
  std::vector<CalibrationSample> calibrations;
  Eigen::Isometry3d T_odom_base;
};

void take(World& world, Recording& recording) {
  while (auto frame = world.takeFrame()) {
    frame->image = frame->image.clone();
    recording.frames.push_back(*frame);
    recording.frame_at_sec.push_back(world.timeSec());
  }
  while (const auto sample = world.takeOdometry()) recording.odometry.push_back(*sample);
  while (const auto sample = world.takeTransform()) recording.transforms.push_back(*sample);
  while (const auto sample = world.takeImu()) recording.imu.push_back(*sample);
  while (const auto sample = world.takeCalibration()) recording.calibrations.push_back(*sample);
  if (const auto time_sec = world.readClock()) recording.clock.push_back(*time_sec);
}

Recording record(const std::vector<FaultParams>& faults, std::uint32_t seed = 1) {
  World world(scenarioWith(faults), seed);
  Recording recording;
  while (world.timeSec() < kOverSec) {
    world.command({Eigen::Vector3d(0.5, 0.2, 0.0), 0.3});
    world.advance();
    take(world, recording);
  }
  recording.T_odom_base = world.truth().T_odom_base;
  return recording;
}

bool sameBytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

bool during(double at_sec) { return at_sec + 1e-9 >= kAtSec && at_sec + 1e-9 < kEndSec; }

const CameraFrame* frameOf(const Recording& recording, double stamp_sec) {
  for (const auto& frame : recording.frames)
    if (frame.stamp_sec == stamp_sec) return &frame;
  return nullptr;
}

TEST(Faults, TheSameSeedGivesTheSameBytesWithEachOfThem) {
  for (const char* unit : {"image", "odom", "imu", "cmd_vel", "clock"})
    for (const char* kind : {"garbage", "delayed"}) {
      if (!whyNoSuchFault(fault(unit, kind)).empty()) continue;
      const Recording first = record({fault(unit, kind)}, 3), again = record({fault(unit, kind)}, 3);
      ASSERT_EQ(first.frames.size(), again.frames.size());
      for (std::size_t i = 0; i < first.frames.size(); ++i)
        ASSERT_TRUE(sameBytes(first.frames[i].image, again.frames[i].image)) << unit << kind << i;
      EXPECT_EQ(first.T_odom_base.matrix(), again.T_odom_base.matrix());
      EXPECT_EQ(first.odometry.size(), again.odometry.size());
      EXPECT_EQ(first.clock, again.clock);
    }
}

TEST(Faults, AFaultOfASensorLeavesTheTruthAndAllOtherImagesAsTheyWere) {
  const Recording healthy = record({});
  for (const char* kind : {"off", "stuck", "garbage", "wrong", "slow", "delayed", "intermittent"}) {
    const Recording faulty = record({fault("image", kind), fault("odom", kind), fault("imu", kind)});
    EXPECT_EQ(faulty.T_odom_base.matrix(), healthy.T_odom_base.matrix()) << kind;
    int compared = 0;
    for (std::size_t i = 0; i < faulty.frames.size(); ++i) {
      const auto* other = frameOf(healthy, faulty.frames[i].stamp_sec);
      ASSERT_NE(other, nullptr) << kind;
      EXPECT_EQ(faulty.frames[i].T_camera_window.matrix(), other->T_camera_window.matrix());
      if (during(faulty.frame_at_sec[i])) continue;
      ++compared;
      EXPECT_TRUE(sameBytes(faulty.frames[i].image, other->image)) << kind << " " << faulty.frame_at_sec[i];
    }
    EXPECT_GE(compared, 22) << kind;
  }
}

TEST(Faults, ImagesAreWhatTheTableSays) {
  const Recording healthy = record({}), stuck = record({fault("image", "stuck")}),
                  garbage = record({fault("image", "garbage")}), mirrored = record({fault("image", "wrong")});
  std::size_t before = 0;
  while (!during(stuck.frame_at_sec[before + 1])) ++before;
  int seen = 0;
  for (std::size_t i = before + 1; during(stuck.frame_at_sec[i]); ++i, ++seen) {
    const cv::Mat& was = frameOf(healthy, stuck.frames[i].stamp_sec)->image;
    EXPECT_TRUE(sameBytes(stuck.frames[i].image, stuck.frames[before].image));
    EXPECT_GT(stuck.frames[i].stamp_sec, stuck.frames[i - 1].stamp_sec);
    cv::Mat flipped;
    cv::flip(was, flipped, 1);
    EXPECT_TRUE(sameBytes(mirrored.frames[i].image, flipped));
    cv::Scalar mean, deviation;
    cv::meanStdDev(garbage.frames[i].image, mean, deviation);
    EXPECT_EQ(garbage.frames[i].image.size(), was.size());
    EXPECT_NEAR(mean[0], 127.5, 6.0);
    EXPECT_NEAR(deviation[0], 73.9, 5.0);
    EXPECT_FALSE(sameBytes(garbage.frames[i].image, garbage.frames[i - 1].image));
  }
  EXPECT_GE(seen, 11);
}

TEST(Faults, OdometryAndTransformAreSpoiltEachForItself) {
  const Recording healthy = record({}), wrong = record({fault("odom", "wrong")});
  EXPECT_EQ(wrong.transforms.back().T_odom_base.matrix(), healthy.transforms.back().T_odom_base.matrix());
  int jumped = 0;
  for (std::size_t i = 0; i < wrong.odometry.size(); ++i) {
    const auto& is = wrong.odometry[i].T_odom_base;
    const auto& was = healthy.odometry[i].T_odom_base;
    EXPECT_EQ(wrong.transforms[i].T_odom_base.matrix(), was.matrix());
    if (is.matrix() == was.matrix()) continue;
    ++jumped;
    EXPECT_NEAR((is.translation() - was.translation()).x(), 4.0, 1e-12);
    EXPECT_NEAR(geometry::wrapAngle(geometry::yawOf(is.linear()) - geometry::yawOf(was.linear())), M_PI_2,
                1e-6);
  }
  EXPECT_EQ(jumped, 20);
}

TEST(Faults, ASlideMovesThePositionAloneAndItStaysThere) {
  FaultParams slide = fault("odom", "slide");
  slide.slide_mps = 0.5;
  slide.direction_rad = M_PI_2;
  const Recording healthy = record({}), slid = record({slide});
  ASSERT_EQ(slid.odometry.size(), healthy.odometry.size());
  for (std::size_t i = 0; i < slid.odometry.size(); ++i) {
    const Eigen::Vector3d moved =
        slid.odometry[i].T_odom_base.translation() - healthy.odometry[i].T_odom_base.translation();
    EXPECT_NEAR(moved.x(), 0.0, 1e-12);
    EXPECT_EQ(slid.odometry[i].velocity_odom_mps, healthy.odometry[i].velocity_odom_mps);
    EXPECT_EQ(slid.transforms[i].T_odom_base.matrix(), slid.odometry[i].T_odom_base.matrix());
    EXPECT_GE(moved.y(), -1e-12);
  }
  const Eigen::Vector3d moved =
      slid.odometry.back().T_odom_base.translation() - healthy.odometry.back().T_odom_base.translation();
  EXPECT_NEAR(moved.y(), 0.5 * (kEndSec - kAtSec), 1e-9);
  EXPECT_NE(whyNoSuchFault(fault("imu", "slide")), "");
}

TEST(Faults, GarbageIsNotFinite) {
  const Recording faulty = record({fault("odom", "garbage"), fault("imu", "garbage"), fault("tf", "garbage"),
                                   fault("camera_info", "garbage")});
  int odometry = 0, transforms = 0, imu = 0, unusable = 0;
  for (const auto& sample : faulty.odometry) odometry += !sample.T_odom_base.matrix().allFinite();
  for (const auto& sample : faulty.transforms) transforms += !sample.T_odom_base.matrix().allFinite();
  for (const auto& sample : faulty.imu) imu += !sample.R_odom_base.coeffs().allFinite();
  for (const auto& sample : faulty.calibrations) unusable += !sample.camera.validate().empty();
  EXPECT_EQ(odometry, 20);
  EXPECT_EQ(transforms, 20);
  EXPECT_EQ(imu, 40);
  EXPECT_EQ(unusable, 12);
}

TEST(Faults, AWrongImuFeelsARollThatIsNot) {
  const Recording healthy = record({}), wrong = record({fault("imu", "wrong")});
  double rolled_rad = 0.0;
  for (std::size_t i = 0; i < wrong.imu.size(); ++i)
    rolled_rad = std::max(rolled_rad, wrong.imu[i].R_odom_base.angularDistance(healthy.imu[i].R_odom_base));
  EXPECT_NEAR(rolled_rad, 0.5, 1e-6);
}

TEST(Faults, AWrongCalibrationZooms) {
  const Recording wrong = record({fault("camera_info", "wrong")});
  std::set<double> focal_px;
  for (const auto& sample : wrong.calibrations) focal_px.insert(sample.camera.fx);
  ASSERT_EQ(focal_px.size(), 2u);
  EXPECT_NEAR(*focal_px.rbegin() / *focal_px.begin(), 1.3, 1e-12);
}

TEST(Faults, AClockStandsStillOrJumpsBack) {
  const Recording stuck = record({fault("clock", "stuck")}), wrong = record({fault("clock", "wrong")});
  EXPECT_EQ(std::count(stuck.clock.begin(), stuck.clock.end(), stuck.clock[158]), 161);
  double back_sec = 0.0;
  for (std::size_t i = 1; i < wrong.clock.size(); ++i)
    back_sec = std::max(back_sec, wrong.clock[i - 1] - wrong.clock[i]);
  EXPECT_NEAR(back_sec, 5.0, 0.01);
  EXPECT_NEAR(wrong.clock.back(), kOverSec, 0.01);
  EXPECT_EQ(record({fault("clock", "off")}).clock.size(), wrong.clock.size() - 160);
}

// Flies forward. \return the position after the fault, in metres ahead and left of the start
Eigen::Vector3d flown(const FaultParams& params) {
  World world(scenarioWith({params}), 1);
  const Eigen::Isometry3d start = world.truth().T_odom_base;
  while (world.timeSec() < 2.0) {
    world.command({Eigen::Vector3d(world.timeSec() < kAtSec ? 0.0 : 1.0, 0.0, 0.0), 0.0});
    world.advance();
  }
  return (start.inverse() * world.truth().T_odom_base).translation();
}

TEST(Faults, CommandsAreWhatTheTableSays) {
  FaultParams params = fault("cmd_vel", "wrong");
  params.duration_sec = 10.0;
  EXPECT_LT(flown(params).x(), -1.0);
  params.kind = "off";
  EXPECT_NEAR(flown(params).norm(), 0.0, 0.05);
  params.kind = "stuck";
  EXPECT_NEAR(flown(params).norm(), 0.0, 0.05);
  params.kind = "garbage";
  EXPECT_GT(std::abs(flown(params).y()), 0.01);
  params.kind = "delayed";
  params.delay_sec = 0.8;
  const double late_m = flown(params).x();
  EXPECT_GT(late_m, 0.1);
  params.duration_sec = 0.01;
  EXPECT_GT(flown(params).x(), late_m + 0.4);
}

TEST(Faults, OfSeveralTheLastBegunCounts) {
  FaultParams early = fault("odom", "off"), late = fault("odom", "stuck");
  early.at_sec = 1.0;
  early.duration_sec = 10.0;
  late.at_sec = 2.0;
  late.duration_sec = 1.0;
  const FaultPlan plan({late, early});
  EXPECT_EQ(plan.acting("odom", 0.99), nullptr);
  EXPECT_EQ(plan.acting("odom", 1.0)->kind, "off");
  EXPECT_EQ(plan.acting("odom", 2.0)->kind, "stuck");
  EXPECT_EQ(plan.acting("odom", 3.0)->kind, "off");
  EXPECT_EQ(plan.acting("imu", 3.0), nullptr);
  EXPECT_EQ(plan.acting("odom", 11.0), nullptr);
}

TEST(Faults, AreInjectedFromNowOn) {
  World world(scenarioWith({}), 1);
  int before = 0, meanwhile = 0, after = 0;
  const auto run = [&world](double until_sec, int& count) {
    for (; world.timeSec() + 1e-9 < until_sec; world.advance()) count += world.takeOdometry().has_value();
  };
  run(0.5, before);
  world.inject(fault("odom", "off"));
  run(0.5 + kEndSec - kAtSec, meanwhile);
  run(1.4, after);
  EXPECT_GT(before, 20);
  EXPECT_LE(meanwhile, 1) << "one may have come before the fault was injected";
  EXPECT_GT(after, 20);
}

TEST(Faults, AreInjectedHoweverLateItIs) {
  constexpr double kLateSec = 5000.0;  // later than a scenario's faults may begin
  FaultPlan plan({});
  plan.inject(fault("odom", "off"), kLateSec);
  EXPECT_EQ(plan.acting("odom", kLateSec - 0.1), nullptr);
  EXPECT_NE(plan.acting("odom", kLateSec), nullptr);
}

TEST(Faults, WhatMakesNoSenseIsRefusedByName) {
  const auto error = [](const FaultParams& params, const char* profile = "default") {
    Scenario scenario = scenarioWith({params});
    scenario.vehicle.profile = profile;
    return test::refusalOf([&] { World(scenario, 1); });
  };
  EXPECT_TRUE(test::says(error(fault("clock", "garbage")), "clock garbage"));
  EXPECT_TRUE(test::says(error(fault("camera_info", "stuck")), "camera_info stuck"));
  EXPECT_TRUE(test::says(error(fault("camera", "off")), "faults[0]/unit"));
  EXPECT_TRUE(test::says(error(fault("odom", "odd")), "faults[0]/kind"));
  FaultParams params = fault("odom", "off");
  params.duration_sec = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(test::says(error(params), "duration_sec"));
  EXPECT_TRUE(test::says(error(fault("odom", "off"), "external"), "odom off"));
  EXPECT_EQ(error(fault("image", "off"), "external"), "");
  World world(scenarioWith({}), 1);
  EXPECT_THROW(world.inject(fault("clock", "garbage")), InputError);
  EXPECT_THROW(world.inject(params), InputError);
}

}  // namespace window_ingress::simulation::faults_test
