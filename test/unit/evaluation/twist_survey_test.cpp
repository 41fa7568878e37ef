#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "estimation/checks/twist_check.hpp"
#include "simulation/scenario/scenario.hpp"
#include "simulation/sensors/odometry_sensor.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::twist_survey_test {

using Meaning =
    std::function<Eigen::Vector3d(const Eigen::Matrix3d& R, const Eigen::Vector3d& velocity_odom)>;

const Meaning kBody = [](const Eigen::Matrix3d& R, const Eigen::Vector3d& v) -> Eigen::Vector3d {
  return R.transpose() * v;
};
const Meaning kWorld = [](const Eigen::Matrix3d&, const Eigen::Vector3d& v) { return v; };
const Meaning kTwice = [](const Eigen::Matrix3d& R, const Eigen::Vector3d& v) -> Eigen::Vector3d {
  return R.transpose() * (R.transpose() * v);
};

simulation::OdometryParams badOdometry(std::mt19937& random) {
  simulation::OdometryParams params;
  params.scale_error = std::uniform_real_distribution<double>(-0.05, 0.05)(random);
  params.drift_m_per_sqrt_sec = 0.05;
  params.height_drift_m_per_sqrt_sec = 0.02;
  params.yaw_drift_rad_per_sqrt_sec = 0.0075;
  params.latency_sec = 0.06;
  return params;
}

/// A minute of hovering, turning on the spot, crawling and flying, a few seconds each.
class Wanderer {
 public:
  Wanderer(unsigned seed, double heading_rad, bool turns)
      : random_(seed), heading_rad_(heading_rad), turns_(turns) {
    truth_.T_odom_base = geometry::makePose(geometry::yawRotation(heading_rad), {0.0, 0.0, 1.3});
  }

  const simulation::VehicleTruth& step(double dt_sec) {
    left_sec_ -= dt_sec;
    if (left_sec_ < 0.0) wish();
    truth_.velocity_odom_mps += (wish_mps_ - truth_.velocity_odom_mps) * dt_sec / 0.3;
    heading_rad_ += turn_radps_ * dt_sec;
    truth_.T_odom_base =
        geometry::makePose(geometry::yawRotation(heading_rad_),
                           truth_.T_odom_base.translation() + dt_sec * truth_.velocity_odom_mps);
    return truth_;
  }

 private:
  void wish() {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const double speed_mps = std::max(0.0, 0.6 * uniform(random_)), way_rad = M_PI * uniform(random_);
    left_sec_ = 2.0 + std::abs(5.0 * uniform(random_));
    wish_mps_ = {speed_mps * std::cos(way_rad), speed_mps * std::sin(way_rad), 0.1 * uniform(random_)};
    turn_radps_ = turns_ ? 0.4 * uniform(random_) : 0.0;
  }

  std::mt19937 random_;
  double heading_rad_, left_sec_ = 0.0, turn_radps_ = 0.0;
  bool turns_;
  Eigen::Vector3d wish_mps_ = Eigen::Vector3d::Zero();
  simulation::VehicleTruth truth_;
};

struct Flight {
  bool alarm = false;  ///< at any time
  double alarm_way_m = 0.0;
  estimation::FramesVerdict last;
};

Flight fly(const simulation::OdometryParams& params, unsigned seed, double heading_rad, bool turns,
           const Meaning& meaning) {
  simulation::OdometrySensor sensor(params, seed);
  Wanderer vehicle(seed, heading_rad, turns);
  estimation::TwistCheck check;
  Flight flight;
  double way_m = 0.0;
  for (int i = 0; i < 60 * 200; ++i) {
    const auto& truth = vehicle.step(0.005);
    way_m += 0.005 * truth.velocity_odom_mps.norm();
    sensor.update(0.005 * i, truth);
    while (const auto sample = sensor.take(0.005 * i)) {
      const Eigen::Matrix3d R = sample->T_odom_base.linear();
      check.add(sample->stamp_sec, sample->T_odom_base, R * meaning(R, sample->velocity_odom_mps));
      if (flight.alarm || check.verdict().state != estimation::FramesVerdict::kWrong) continue;
      flight.alarm = true;
      flight.alarm_way_m = way_m;
    }
  }
  flight.last = check.verdict();
  return flight;
}

struct Count {
  int alarms = 0, lasting = 0, named = 0;
  double latest_m = 0.0;
};

/// \param name text that the alarm must contain
Count count(const Meaning& meaning, double heading_rad, bool turns, const char* name, unsigned first_seed,
            unsigned flights, bool bad) {
  std::mt19937 random(first_seed);
  Count count;
  for (unsigned i = 0; i < flights; ++i) {
    const auto params = bad ? badOdometry(random) : simulation::OdometryParams();
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const Flight flight = fly(params, first_seed + i, side * heading_rad, turns, meaning);
    count.alarms += flight.alarm;
    count.lasting += flight.last.state == estimation::FramesVerdict::kWrong;
    count.named += flight.last.what.find(name) != std::string::npos;
    count.latest_m = std::max(count.latest_m, flight.alarm_way_m);
  }
  return count;
}

TEST(TwistSurvey, OdometryThatIsMerelyBadRaisesNoAlarm) {
  for (int tenth = 0; tenth <= 30; ++tenth)
    for (const bool turns : {false, true}) {
      EXPECT_EQ(count(kBody, 0.1 * tenth, turns, "", 100 * tenth + 1, 5, true).alarms, 0) << tenth;
      EXPECT_EQ(count(kBody, 0.1 * tenth, turns, "", 100 * tenth + 1, 5, false).alarms, 0) << tenth;
    }
}

TEST(TwistSurvey, AVelocityThatIsBiasedOrWandersHardlyEverRaisesOne) {
  for (const char* profile : {"px4_1_13_gps", "arducopter_4_0_default"}) {
    simulation::QuadrotorParams vehicle;
    simulation::OdometryParams params;
    simulation::applyProfile(profile, vehicle, params);
    int alarms = 0;
    for (unsigned seed = 1; seed <= 400; ++seed)
      alarms += fly(params, seed, std::remainder(0.7 * seed, 2.0 * M_PI), seed % 2 == 0, kBody).alarm;
    EXPECT_LE(alarms, 1) << profile;
  }
}

TEST(TwistSurvey, WrongAxesAreNamedWhateverTheOdometry) {
  for (const bool bad : {false, true})
    for (const double heading : {0.15, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 2.0, 2.5, 3.0}) {
      const Count world = count(kWorld, heading, false, "world frame", 5001, 20, bad);
      const Count twice = count(kTwice, heading, false, "twice", 6001, 20, bad);
      std::printf(
          "%s odometry, heading %.2f rad: of 40 found %d, still at the end %d, the latest after %.1f m\n",
          bad ? "bad" : "good", heading, world.alarms + twice.alarms, world.lasting + twice.lasting,
          std::max(world.latest_m, twice.latest_m));
      for (const Count& found : {world, twice}) {
        const bool must_be = heading >= 0.5 || (heading >= 0.4 && !bad);
        EXPECT_GE(found.alarms, must_be ? (bad ? 19 : 20) : 0) << heading << ' ' << bad;
        EXPECT_GE(found.named, found.lasting - 2)
            << heading << ' ' << bad;  // near pi the opposite sign may fit, too
        EXPECT_LE(found.alarms, heading < 0.2 ? 2 : 20) << "both are nearly the same";
      }
    }
}

}  // namespace window_ingress::twist_survey_test
