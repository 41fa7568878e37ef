#include "window_ingress/navigation/navigator.hpp"

#include <algorithm>
#include <cmath>

#include "navigation/behaviours/position_hold.hpp"
#include "navigation/mission/flown_window.hpp"
#include "navigation/mission/mission_clock.hpp"
#include "navigation/mission/mission_rules.hpp"
#include "navigation/mission/opening_policy.hpp"
#include "navigation/mission/start_conditions.hpp"
#include "navigation/mission/window_choice.hpp"
#include "navigation/motion/disturbance_observer.hpp"
#include "navigation/motion/pending_yaw.hpp"
#include "navigation/motion/permitted_directions.hpp"
#include "navigation/motion/setpoint_limiter.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {
constexpr double kBeyondFenceM = 1.0;
constexpr const char* kIgnored =
    "; told to move, the vehicle stands by its odometry: does the autopilot follow the setpoints?";

struct Navigator::Impl {
  explicit Impl(const NavigatorParams& given)
      : params(checked(given)),
        monitor(params.input),
        limiter(params.limits),
        observer(params.vehicle, params.approach),
        reason(waiting()) {}

  NavigatorParams params;
  const double told_braking_mps2 = params.vehicle.braking_mps2;  ///< the measured value may be smaller
  const CommitParams told_commit = params.commit;                ///< a mission may have its own policy
  InputMonitor monitor;
  SetpointLimiter limiter;
  DisturbanceObserver observer;
  PendingYaw turn;
  State state = State::kIdle;
  std::unique_ptr<Behaviour> behaviour;  ///< of the present state, if it has one
  std::string reason;
  MissionState mission;
  FlownWindow flown_at;
  Setpoint last_setpoint;
  MissionClock clock;
  bool held_by_fence = false;
  bool stands_down = false;  ///< aborted after the mission's end: no longer keeps its place

  std::string waiting() const { return "waiting for start; " + whatIsAssumed(params.commit); }
  bool isFlownAt() const { return state == State::kAlign || state == State::kApproach; }
  std::string byFence() const {
    return held_by_fence ? "; the fence (limits/fence_radius_m) holds the vehicle" : "";
  }
  bool isIgnored() const {
    return isMoving(state) && observer.ignoresSetpoints() && params.input.max_turned_rad < M_PI;
  }
  bool isLive() const { return isMoving(state) || state == State::kHold; }
  bool isInOpening(const Situation& situation) const {
    return state == State::kCommit && situation.vehicle && mission.committed &&
           relate(*situation.vehicle, *mission.committed).distance() < params.vehicle.half_length_m;
  }

  void follow(const MissionPolicy& policy) {
    params.commit.unverified_opening =
        policy.unverified_opening.empty() ? told_commit.unverified_opening : policy.unverified_opening;
    params.commit.glass = policy.glass.empty() ? told_commit.glass : policy.glass;
  }

  // Measures wind, gusts, and the vehicle's response to its setpoints.
  void observe(Situation& situation) {
    if (situation.vehicle_jumped) {
      observer.restart();
      turn.reset();
    }
    situation.told_odom_mps = last_setpoint.velocity_odom_mps;
    if (!situation.vehicle) return;
    turn.update(geometry::yawOf(situation.vehicle->T_odom_base.linear()), last_setpoint.yaw_rate_radps,
                situation.dt_sec);
    situation.pending_yaw_rad = turn.rad();
    observer.update(situation.vehicle->velocity_odom_mps, last_setpoint.velocity_odom_mps, situation.dt_sec);
    if (observer.response().isMeasured()) situation.wind_odom_mps = observer.disturbance();
    situation.gusts_odom = observer.gusts();
    situation.gusts_watched_sec = observer.watchedSec();
    params.vehicle.response_sec = observer.response().responseSec();
    params.vehicle.climb_response_sec = observer.climbResponse().responseSec();
    params.vehicle.braking_mps2 = std::min(told_braking_mps2, observer.response().accelerationMps2());
  }

  void remember(const Situation& situation, const NavigatorInput& input) {
    const auto& vehicle = situation.vehicle;
    const auto& target = situation.target;
    if (situation.vehicle_jumped) mission.forgetPlaces();
    if (vehicle) mission.followVehicle(vehicle->T_odom_base.translation(), monitor.odometry().carriedM());
    if (vehicle && mission.trusted)
      mission.was_in_front = relate(*vehicle, *mission.trusted).distance() >
                             params.vehicle.half_length_m + params.vehicle.margin_m;
    if (state == State::kCommit) {
      mission.trusted = mission.committed;
    } else if (target && vehicle && (isFlownAt() || !isKnownOther(*target, *vehicle, mission))) {
      mission.window_odom_m = target->T_odom_window.translation();
      if (target->sign_trusted) mission.trusted = target;
    } else if (!target && input.remembered_odom_m && input.remembered_odom_m->allFinite()) {
      mission.window_odom_m = monitor.odometry().T_smooth_odom(situation.now_sec) * *input.remembered_odom_m;
    }
    const bool flies_at = state == State::kApproach || state == State::kCommit;
    flown_at.follow(flies_at ? mission.trusted : std::nullopt, situation, monitor.odometry());
  }

  // The mission does not exchange a window that it flies at, and flies at none from behind. COMMIT judges its
  // own sightings.
  void keepToWindow(Situation& situation) const {
    if (state == State::kCommit || !situation.target || !situation.vehicle) return;
    const std::string why_not = whyNotFlownAt(*situation.target, *situation.vehicle, state, mission);
    if (why_not.empty()) return;
    situation.target.reset();
    situation.target_is_new = false;
    situation.target_fault = why_not;
  }

  std::optional<Decision> overrule(const NavigatorInput& input, const Situation& situation) const {
    const auto stop = [](Event event, const std::string& why) { return Decision{{}, false, event, why}; };
    if (!isLive()) return staying();
    if (!input.engaged) return stop(Event::kDisengaged, "the vehicle no longer follows setpoints");
    const std::string timed_out = whatTimedOut(state, clock, mission, params);
    if (!timed_out.empty()) return stop(Event::kGiveUp, timed_out + byFence());
    if (mission.from_home_m.head<2>().norm() > params.limits.fence_radius_m + kBeyondFenceM)
      return stop(Event::kGiveUp, "outside the fence");
    const std::string beside = isInOpening(situation) ? "" : howItMovesBeside(observer, params.input);
    if (!beside.empty()) return stop(Event::kGiveUp, beside);
    const std::string missing = isMoving(state) ? missingInput(state, situation) : "";
    return missing.empty() ? std::nullopt : std::optional(stop(Event::kInputStale, missing));
  }

  Decision decide(const NavigatorInput& input, const Situation& situation, const std::string& elsewhere) {
    if (auto overruled = overrule(input, situation)) return *overruled;
    if (!elsewhere.empty() && isFlownAt()) return {{}, true, Event::kOtherWindow, elsewhere};
    Decision decision = behave(situation);
    if (decision.event == Event::kOtherWindow) leaveOtherWindow(situation, mission);
    turnToNextWindow(state, params, mission, decision);
    return decision;
  }

  Decision behave(const Situation& situation) {
    return behaviour ? behaviour->step(situation, mission) : staying();
  }

  Decision staying() const {
    const bool keeps_place = state == State::kHold || (state == State::kPassed && !stands_down);
    return {{}, keeps_place, std::nullopt, reason};
  }

  void change(State to, const std::string& why) {
    clock.enterState();
    reason = why;
    mission.was_near = mission.was_near || to == State::kApproach;
    behaviour = behaviourOf(to, state, clock.nowSec(), !mission.was_near, params);
    if (to == State::kBackOff) ++mission.back_offs;
    if (isMoving(to) && to != State::kCommit) mission.committed.reset();  // its place is outdated
    if (to == State::kHold) observer.restart();  // the present disturbance may not be wind
    state = to;
  }

  Setpoint setpointFor(const Decision& decision, const Situation& situation) {
    held_by_fence = false;
    if (!mayHaveVelocity(state) || !situation.vehicle) return limiter.stop();
    Setpoint wish = decision.wish;
    if (decision.keeps_place) {
      const Eigen::Vector3d back = velocityToPlace(*situation.vehicle, mission, params);
      wish.velocity_odom_mps.head<2>() = back.head<2>();
      if (wish.velocity_odom_mps.z() == 0.0) wish.velocity_odom_mps.z() = back.z();
    }
    Setpoint limited = limiter.limit(wish, situation.dt_sec);
    held_by_fence = isHeldByFence(limited.velocity_odom_mps, situation, mission, params);
    limited.velocity_odom_mps =
        permittedVelocity(limited.velocity_odom_mps, state, situation, mission, params);
    return limiter.cutTo(limited);
  }

  NavigatorReport reportOn(const Situation& situation) const {
    NavigatorReport report;
    report.predicted_miss_m = mission.predicted_miss_m;
    report.blind_sec = mission.blind_sec;
    report.retries = mission.back_offs;
    report.window_id = mission.trusted ? mission.trusted->window_id : 0;
    report.given_up = mission.given_up;
    report.next_window = params.search.next_window;
    const ResponseEstimator& response = observer.response();
    report.vehicle = {response.isMeasured(), response.responseSec(), response.accelerationMps2(),
                      monitor.odometry().biasMps(), isIgnored()};
    const auto& target = mission.committed ? mission.committed : situation.target;
    if (!target || !situation.vehicle) return report;
    const RelativeState relative = relate(*situation.vehicle, *target);
    report.has_relative = true;
    report.lateral_m = relative.lateral();
    report.vertical_m = relative.vertical();
    report.distance_m = relative.distance();
    report.commit_distance_m = commitDistance(relative, target->opening, pitchOf(*situation.vehicle), params);
    return report;
  }
};

Navigator::Navigator(const NavigatorParams& params) : impl_(new Impl(params)) {}
Navigator::~Navigator() = default;

Reply Navigator::start(const NavigatorInput& input, double now_sec, const MissionPolicy& policy) {
  auto& self = *impl_;
  if (self.isLive()) return {true, std::string("already flying: ") + toString(self.state)};
  if (isEnd(self.state))
    return {false, std::string("mission ended as ") + toString(self.state) + ": reset first"};
  InputMonitor judge = self.monitor;
  const Situation situation = judge.judge(input, now_sec);
  const auto faults = unmetToStart(situation, input.engaged, self.flown_at, self.params);
  if (!faults.empty()) return {false, "not started: " + parameters::joined(faults)};
  self.follow(policy);
  self.mission = MissionState();
  self.mission.was_near = self.flown_at.mayHaveRoofAbove(*situation.vehicle);
  self.observer.reset();
  self.turn.reset();
  self.stands_down = false;
  self.limiter.stop();
  self.clock.startMission(now_sec);
  self.change(*next(self.state, Event::kStart), "started");
  const std::string forbidden = input.target ? input.target->approach_forbidden : "";
  return {true, "started; " + whatIsAssumed(self.params.commit) +
                    (forbidden.empty() ? "" : "; the approach is forbidden so far: " + forbidden)};
}

Reply Navigator::abort(const std::string& why) {
  auto& self = *impl_;
  const auto to = next(self.state, Event::kAbort);
  self.limiter.stop();
  self.stands_down = true;
  if (!to) return {true, std::string("already ended as ") + toString(self.state)};
  self.change(*to, why);
  return {true, self.reason};
}

Reply Navigator::reset() {
  auto& self = *impl_;
  if (self.state == State::kIdle) return {true, "already idle"};
  const auto to = next(self.state, Event::kReset);
  if (!to) return {false, std::string("flying: ") + toString(self.state) + "; abort first"};
  self.flown_at.bringToOdom(self.monitor.odometry(), self.clock.nowSec());
  self.monitor.reset();
  self.follow({});
  self.change(*to, self.waiting());
  return {true, "reset"};
}

Reply Navigator::confirmOpening() {
  auto& self = *impl_;
  if (!self.isFlownAt() || !self.mission.trusted)
    return {false, std::string("no window is being approached: ") + toString(self.state)};
  if (!self.mission.opening_asked && !self.mission.opening_confirmed)
    return {false, "not asked yet: the vehicle asks while it waits at the commit line"};
  self.mission.opening_confirmed = true;
  return {true, "confirmed: the window is open and has no glass"};
}

State Navigator::state() const { return impl_->state; }

void Navigator::sentZero() { impl_->last_setpoint = impl_->limiter.stop(); }

NavigatorOutput Navigator::step(const NavigatorInput& input, double now_sec) {
  auto& self = *impl_;
  // An unusable camera changes nothing: no mission starts with it.
  if (input.camera && faultOf(*input.camera).empty()) self.params.vehicle.camera = *input.camera;
  Situation situation = self.monitor.judge(input, now_sec);
  const std::string elsewhere = whySentElsewhere(situation, self.state, self.mission);
  if (!elsewhere.empty()) self.mission.leaveWindow();
  self.keepToWindow(situation);
  self.clock.pass(now_sec);
  self.observe(situation);
  self.remember(situation, input);
  Decision decision = self.decide(input, situation, elsewhere);
  self.reason = decision.reason;
  const auto to = decision.event ? next(self.state, *decision.event) : std::nullopt;
  if (to) {
    self.change(*to, decision.reason);
    decision = isMoving(*to) ? self.behave(situation) : self.staying();
  }
  rememberPlace(decision.keeps_place && input.engaged, situation, self.params.hold, self.mission);
  NavigatorOutput output;
  output.setpoint = self.last_setpoint = self.setpointFor(decision, situation);
  output.setpoint.velocity_odom_mps = self.monitor.odometry().inOdomAxes(output.setpoint.velocity_odom_mps);
  output.setpoint.heading_error_rad = self.monitor.odometry().headingErrorRad();
  self.monitor.told(output.setpoint, now_sec);
  output.state = self.state;
  output.reason = self.reason + self.byFence() + (self.isIgnored() ? kIgnored : "");
  output.report = self.reportOn(situation);
  const bool streams =
      self.state != State::kAborted || self.clock.inStateSec() <= self.params.timeouts.stream_sec;
  output.enabled = self.state != State::kIdle && streams;
  return output;
}

}  // namespace window_ingress::navigation
