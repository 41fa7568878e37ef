/// Rules that hold for any input: 3 10^5 steps of hostile inputs. The rules are written independently of the
/// navigator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "navigation_samples.hpp"
#include "window_ingress/navigation/navigator.hpp"
#include "window_ingress/navigation/relative_state.hpp"

namespace window_ingress::navigation::invariants_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// A vehicle that roughly obeys, and inputs that are sometimes corrupted.
class HostileWorld {
 public:
  explicit HostileWorld(unsigned seed) : random_(seed) {}

  NavigatorInput input() {
    NavigatorInput input;
    if (!chance(0.01)) input.vehicle = vehicle();
    if (!chance(0.02)) input.target = target();
    if (!chance(0.02)) input.image_stamp_sec = now_ - (chance(0.01) ? 5.0 : 0.1);
    input.engaged = !chance(0.0005);
    return input;
  }
  double now() { return chance(0.001) ? spoilt() : now_; }

  void advance(const Setpoint& setpoint) {
    now_ += chance(0.002) ? (chance(0.3) ? -3.0 : 2.0) : 0.033;
    position_ += setpoint.velocity_odom_mps * 0.033;
    velocity_ = setpoint.velocity_odom_mps;
    yaw_ += setpoint.yaw_rate_radps * 0.033;
    if (chance(0.002)) position_ = Eigen::Vector3d(-6 * uniform(), 6 * uniform() - 3, 3 * uniform());
    if (chance(0.01)) is_trusted_ = !is_trusted_;
    if (chance(0.002)) is_unverified_ = !is_unverified_;
    if (chance(0.01)) is_seen_ = !is_seen_ || chance(0.5);
    if (is_seen_) seen_sec_ = now_ - 0.05 * uniform();
  }
  void restart() { position_ = Eigen::Vector3d(-2 - 3 * uniform(), 4 * uniform() - 2, 1.5); }

 private:
  double uniform() { return uniform_(random_); }
  bool chance(double probability) { return uniform() < probability; }
  double spoilt() {
    const double values[] = {kNan, kInf, -kInf, 1e300, -1e300, 0.0, 1e-300, 1e10, -5.0};
    return values[static_cast<int>(uniform() * 9)];
  }
  VehicleState vehicle() {
    auto vehicle = test::vehicleAt(position_, now_ - 0.03 * uniform(), yaw_);
    vehicle.velocity_odom_mps = velocity_;
    if (chance(0.01)) vehicle.stamp_sec -= uniform();
    if (chance(0.005)) vehicle.stamp_sec += uniform();
    if (chance(0.003)) vehicle.T_odom_base.translation()(static_cast<int>(3 * uniform())) = spoilt();
    if (chance(0.003)) vehicle.T_odom_base.linear()(1, static_cast<int>(3 * uniform())) = spoilt();
    if (chance(0.003)) vehicle.velocity_odom_mps(static_cast<int>(3 * uniform())) = spoilt();
    if (chance(0.001)) vehicle.stamp_sec = spoilt();
    return vehicle;
  }
  TargetEstimate target() {
    auto target = test::targetAtOrigin(seen_sec_, is_trusted_);
    target.T_odom_window.linear() = geometry::yawRotation(0.05 * uniform());
    if (chance(0.01)) target.T_odom_window.translation().y() += 2 * uniform();
    if (chance(0.01)) target.T_odom_window.translation()(static_cast<int>(3 * uniform())) = spoilt();
    if (chance(0.01))
      target.covariance(static_cast<int>(6 * uniform()), static_cast<int>(6 * uniform())) = spoilt();
    if (chance(0.01)) target.opening.width_m = spoilt();
    if (chance(0.01)) target.stamp_sec = spoilt();
    target.openness.openness = is_unverified_ ? openness::Openness::kUnknown : openness::Openness::kOpen;
    if (chance(0.003)) target.openness.openness = openness::Openness::kClosed;
    if (chance(0.005)) target.other_window = chance(0.1) ? spoilt() : 0.6;
    if (chance(0.01) || target.other_window) target.approach_forbidden = "not there";
    return target;
  }

  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_;
  Eigen::Vector3d position_{-4, 1, 1.5}, velocity_ = Eigen::Vector3d::Zero();
  double yaw_ = 0.0, now_ = 100.0, seen_sec_ = 100.0;
  bool is_trusted_ = true, is_seen_ = true, is_unverified_ = false;
};

/// Odometry received so far. It is usable if the newest sample is fresh and arrived a moment ago, and this
/// step's sample is valid.
struct FreshVehicle {
  double newest_sec = -1e9, arrived_sec = -1e9;
  bool see(const NavigatorInput& input, double now, const InputParams& params) {
    if (!input.vehicle || !faultOf(*input.vehicle).empty() || !std::isfinite(now)) return false;
    const double stamp_sec = input.vehicle->stamp_sec;
    if (!isFresh(newest_sec, now, params)) newest_sec = -1e9;
    if (isFresh(stamp_sec, now, params) && stamp_sec > newest_sec) newest_sec = stamp_sec, arrived_sec = now;
    return isFresh(newest_sec, now, params) && now - arrived_sec <= InputMonitor::kMissingSec;
  }
  static bool isFresh(double stamp_sec, double now, const InputParams& params) {
    return now - stamp_sec <= params.max_vehicle_age_sec && now - stamp_sec >= -params.max_future_sec;
  }
};

/// Valid targets received so far. The navigator may use any of them that is still fresh.
struct FreshTargets {
  double trusted_sec = -1e9;
  void see(const NavigatorInput& input, double now, const InputParams& params) {
    if (!input.target || !std::isfinite(now)) return;
    const auto& target = *input.target;
    const double age = now - target.stamp_sec;
    if (!faultOf(target).empty() || !(age <= params.max_target_age_sec)) return;
    if (age < -params.max_future_sec) return;
    if (target.sign_trusted) trusted_sec = std::max(trusted_sec, target.stamp_sec);
  }
};

void expectWithinLimits(const Setpoint& setpoint, const LimitParams& limits) {
  ASSERT_TRUE(setpoint.velocity_odom_mps.allFinite());
  ASSERT_TRUE(std::isfinite(setpoint.yaw_rate_radps));
  ASSERT_LE(setpoint.velocity_odom_mps.norm(), limits.speed_mps + 1e-9);
  ASSERT_LE(std::abs(setpoint.yaw_rate_radps), limits.yaw_rate_radps + 1e-9);
}

/// \param hold_speed_mps speed of the return to the kept place; 0: no place is kept
void expectInvariants(double hold_speed_mps) {
  NavigatorParams params = test::withoutGlass();
  params.hold.speed_mps = hold_speed_mps;
  const bool goes_back = hold_speed_mps > 0.0;
  int flown = 0, forward = 0, committed = 0, kept = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    HostileWorld world(seed);
    Navigator navigator(params);
    FreshTargets fresh;
    FreshVehicle vehicle;
    Setpoint before;
    double before_sec = 0.0;
    for (int i = 0; i < 5000; ++i) {
      const auto input = world.input();
      const double now = world.now();
      if (i % 20 == 0) navigator.start(input, now);
      fresh.see(input, now, params.input);
      const bool has_vehicle = vehicle.see(input, now, params.input);
      const auto output = navigator.step(input, now);
      const Eigen::Vector3d velocity = output.setpoint.velocity_odom_mps;
      expectWithinLimits(output.setpoint, params.limits);
      if (testing::Test::HasFatalFailure()) return;

      if (!has_vehicle) {
        ASSERT_EQ(velocity.norm(), 0.0) << toString(output.state);
      }
      if (!mayHaveVelocity(output.state)) {
        ASSERT_EQ(velocity.norm(), 0.0) << toString(output.state);
      }
      if (!isMoving(output.state)) {
        ASSERT_LE(velocity.head<2>().norm(), params.hold.speed_mps + 1e-9) << toString(output.state);
        ASSERT_LE(std::abs(velocity.z()), params.hold.speed_mps + 1e-9) << toString(output.state);
      }
      const bool was_trusted = now - fresh.trusted_sec <= params.input.max_target_age_sec;
      // Only a trusted window permits forward motion, and the kept place a slow return. The window's normal
      // is odom's x axis within 0.05 rad.
      if (output.state != State::kCommit && !was_trusted) {
        ASSERT_LE(velocity.x(), goes_back ? params.hold.speed_mps + 1e-9 : 0.06) << toString(output.state);
      }
      // Without a trusted window, lateral motion is at most the return to the kept place.
      if (output.state == State::kSearch || (output.state == State::kAlign && !was_trusted)) {
        ASSERT_LE(velocity.head<2>().norm(), params.hold.speed_mps + 1e-9);
        kept += velocity.head<2>().norm() > 0.0;
      }
      const double dt = std::min(0.2, std::max(0.0, now - before_sec));
      if (std::isfinite(dt) && velocity.norm() > before.velocity_odom_mps.norm()) {
        ASSERT_LE(velocity.norm() - before.velocity_odom_mps.norm(),
                  params.limits.acceleration_mps2 * dt + 1e-9);
      }
      flown += isMoving(output.state);
      forward += velocity.x() > 0.2;
      committed += output.state == State::kCommit;
      before = output.setpoint;
      if (std::isfinite(now)) before_sec = now;
      world.advance(output.setpoint);
      if (isEnd(output.state)) {
        navigator.reset();
        world.restart();
      }
    }
  }
  EXPECT_GT(flown, 10000);  // the vehicle has moved in this test
  EXPECT_GT(forward, 250);
  EXPECT_GT(committed, 25);
  EXPECT_EQ(kept > 25, goes_back);
}

TEST(NavigatorInvariants, HoldForHostileInput) { expectInvariants(HoldParams().speed_mps); }

TEST(NavigatorInvariants, HoldForHostileInputWhereNoPlaceIsKept) { expectInvariants(0.0); }

TEST(NavigatorInvariants, StaleOrBrokenOdometryStopsInTheSameStepInEveryState) {
  const NavigatorParams params = test::withoutGlass();
  for (int moment = 1; moment < 110; moment += 3) {
    for (int kind = 0; kind < 5; ++kind) {
      Navigator navigator(params);
      Eigen::Vector3d position(-3.0, 0.6, 1.5);
      double now = 10.0;
      navigator.start(test::inputAt(position, now), now);
      for (int i = 0; i < moment; ++i) {
        now += 0.033;
        position += navigator.step(test::inputAt(position, now), now).setpoint.velocity_odom_mps * 0.033;
      }
      now += 0.033;
      auto input = test::inputAt(position, now);
      if (kind == 0) input.vehicle.reset();
      if (kind == 1) input.vehicle->velocity_odom_mps.x() = kNan;
      if (kind == 2) input.vehicle->T_odom_base.translation().z() = kInf;
      if (kind == 3) {
        now += params.input.max_vehicle_age_sec;
        input.vehicle->stamp_sec = now - params.input.max_vehicle_age_sec - 0.01;
      }
      if (kind == 4) {  // the last one again
        input.vehicle->stamp_sec = now - 0.033;
        now += InputMonitor::kMissingSec;
      }
      const auto output = navigator.step(input, now);
      EXPECT_EQ(output.setpoint.velocity_odom_mps.norm(), 0.0);
      EXPECT_EQ(output.setpoint.yaw_rate_radps, 0.0);
    }
  }
}

}  // namespace window_ingress::navigation::invariants_test
