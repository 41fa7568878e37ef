#include "simulation/referee.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/text/text.hpp"

namespace window_ingress::simulation {
namespace {

constexpr double kAirborneGap_m = 0.05;

}  // namespace

const char* toString(Outcome outcome) {
  constexpr const char* kNames[] = {"RUNNING", "PASSED", "COLLISION", "FALSE_INGRESS", "ABORTED", "TIMEOUT"};
  return kNames[static_cast<std::size_t>(outcome)];
}

Referee::Referee(const Course& course) : course_(course) {}

void Referee::update(double time_sec, const VehicleTruth& truth) {
  Sample now;
  now.time_sec = time_sec_ = time_sec;
  now.T_window_base = course_.T_odom_window.inverse() * truth.T_odom_base;
  now.position = now.T_window_base.translation();
  now.reach_m = boundingHalfExtents(now.T_window_base.linear(), course_.vehicle_half_extents_m);
  const double speed_mps = truth.velocity_odom_mps.norm();
  max_speed_mps_ = std::max(max_speed_mps_, speed_mps);
  watchContacts(now);
  watchNearest(now);
  watchSides(now);
  watchCrossing(now);
  watchClearance(now);
  watchStanding(now, speed_mps);
  previous_ = now;
}

void Referee::touch(const std::string& name, double time_sec) {
  if (touched()) return;
  contact_ = name;
  contact_time_sec_ = time_sec;
}

void Referee::watchContacts(const Sample& now) {
  const double gap_m = now.position.z() - now.reach_m.z() - course_.ground_z_m;
  airborne_ = airborne_ || gap_m > kAirborneGap_m;
  if (airborne_ && gap_m <= 0.0) touch("ground", now.time_sec);
  const double reach_m = now.reach_m.norm();
  for (const Obstacle& obstacle : course_.obstacles) {
    if (touched()) return;
    if (obstacle.box.squaredExteriorDistance(now.position) > reach_m * reach_m) continue;
    if (touches(now.T_window_base, course_.vehicle_half_extents_m, obstacle.box))
      touch(obstacle.name, now.time_sec);
  }
}

void Referee::watchNearest(const Sample& now) {
  if (!airborne_) return;
  for (const Obstacle& obstacle : course_.obstacles) {
    const Eigen::AlignedBox3d grown(obstacle.box.min() - now.reach_m, obstacle.box.max() + now.reach_m);
    const double square = grown.squaredExteriorDistance(now.position);
    if (square < nearest_m_ * nearest_m_) nearest_m_ = std::sqrt(square);
  }
}

void Referee::watchSides(const Sample& now) {
  const double y_m = now.position.y();
  if (!start_y_m_) start_y_m_ = y_m;
  if (now.position.x() >= 0.0) return;
  wrong_side_m_ = std::max(wrong_side_m_, std::abs(y_m) - std::abs(*start_y_m_));
}

void Referee::watchCrossing(const Sample& now) {
  if (!previous_) return;
  const Eigen::Vector3d a = previous_->position, b = now.position;
  if (a.x() >= 0.0 && b.x() < 0.0) {
    crossing_.reset();
    stood_behind_ = false;
  }
  if (!(a.x() < 0.0 && b.x() >= 0.0)) return;
  const double part = -a.x() / (b.x() - a.x());
  const Eigen::Vector3d at = a + part * (b - a);
  const bool inside = std::abs(at.y()) + now.reach_m.y() <= 0.5 * course_.opening.width_m &&
                      std::abs(at.z()) + now.reach_m.z() <= 0.5 * course_.opening.height_m;
  const double time_sec = previous_->time_sec + part * (now.time_sec - previous_->time_sec);
  crossing_ = Crossing{time_sec, at.y(), at.z(), inside};
}

void Referee::watchClearance(const Sample& now) {
  if (now.position.x() + now.reach_m.x() < 0.0 ||
      now.position.x() - now.reach_m.x() > course_.wall_thickness_m)
    return;
  const double sideways_m = 0.5 * course_.opening.width_m - std::abs(now.position.y()) - now.reach_m.y();
  const double upright_m = 0.5 * course_.opening.height_m - std::abs(now.position.z()) - now.reach_m.z();
  const double clearance_m = std::min(sideways_m, upright_m);
  const bool centre_outside = sideways_m + now.reach_m.y() < 0.0 || upright_m + now.reach_m.z() < 0.0;
  if (centre_outside) return;
  min_clearance_m_ = std::min(min_clearance_m_.value_or(clearance_m), clearance_m);
}

void Referee::watchStanding(const Sample& now, double speed_mps) {
  const bool behind = now.position.x() - now.reach_m.x() > course_.wall_thickness_m;
  if (!behind || speed_mps >= kStandingSpeed_mps) {
    standing_since_sec_.reset();
    return;
  }
  if (!standing_since_sec_) standing_since_sec_ = now.time_sec;
  stood_behind_ = stood_behind_ || now.time_sec - *standing_since_sec_ >= kStandingTime_sec;
}

Verdict Referee::judge(Claim claim, double mission_start_sec) const {
  const auto sinceStart = [&](double sec) { return sec - mission_start_sec; };  // as all reported times
  const bool crossed_inside = crossing_ && crossing_->inside;
  if (touched())
    return {Outcome::kCollision,
            "touched " + contact_ + formatted(" at %.2f s", sinceStart(contact_time_sec_))};
  if (crossed_inside && stood_behind_)
    return {Outcome::kPassed,
            formatted("crossed at %.2f s, %+.3f m left and %+.3f m up of the centre",
                      sinceStart(crossing_->time_sec), crossing_->offset_y_m, crossing_->offset_z_m)};
  if (claim == Claim::kPassed && !crossed_inside)
    return {Outcome::kFalseIngress,
            formatted("claims to have passed at %.2f s ", sinceStart(time_sec_)) +
                (crossing_ ? formatted("but crossed %+.3f m left and %+.3f m up of the centre",
                                       crossing_->offset_y_m, crossing_->offset_z_m)
                           : "and is not behind the window's plane")};
  if (claim == Claim::kAborted)
    return {Outcome::kAborted, formatted("gave up at %.2f s", sinceStart(time_sec_))};
  if (time_sec_ - mission_start_sec >= course_.time_limit_sec)
    return {Outcome::kTimeout, formatted("not done after %.1f s", course_.time_limit_sec)};
  return {Outcome::kRunning, ""};
}

}  // namespace window_ingress::simulation
