#include "window_ingress/navigation/commit_criterion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "navigation/motion/moving_target.hpp"
#include "navigation/motion/stopping.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {
namespace {

// Fitted: measured strength of gusts against the miss at the plane, in flights at 4, 7 and 9.6 m/s.
constexpr double kCalmMps = 0.041, kStrongGustFactor = 1.7;
constexpr double kGustSec = 3.0;  // time scale of gusts: a short measurement may miss the strongest
constexpr double kLeastWatchedSec = 0.01;
constexpr double kPartCarried = 0.73;  // fraction of the distance until a gust is answered and corrected
constexpr double kMaxHeadingErrorRad = 0.2;  // heading against the window's normal
constexpr double kMaxAcrossMps = 0.3;        // velocity across the window's normal at the commit line
constexpr double kUsualOdometryMps = 0.06;  // usual difference between position and velocity over two seconds

/// Distance below which the opening is larger than the image. A commit never starts further off the axis than
/// half of the opening; there, yaw and height keep it in view.
double viewDistance(const RelativeState& relative, const geometry::OpeningSize& opening, double pitch_rad,
                    const VehicleParams& vehicle) {
  const double half_v_rad = std::max(0.1, vehicle.camera.vertical_fov_rad / 2.0 - std::abs(pitch_rad));
  const double half_width_m = opening.width_m / 2.0, half_height_m = opening.height_m / 2.0;
  const double wide_m = half_width_m + std::min(std::abs(relative.lateral()), half_width_m);
  const double high_m = half_height_m + std::min(std::abs(relative.vertical()), half_height_m);
  return std::max(wide_m / std::tan(vehicle.camera.horizontal_fov_rad / 2.0), high_m / std::tan(half_v_rad)) +
         vehicle.camera.forward_m;
}

/// Fraction of an offset that remains when the nose reaches the opening, after steering with a delay.
double remaining(const RelativeState& relative, const NavigatorParams& params) {
  const double way_m = relative.distance() - params.vehicle.half_length_m;
  const double steering_sec = way_m / params.commit.speed_mps - params.vehicle.response_sec;
  return std::exp(-params.align.lateral_gain_hz * std::max(0.0, steering_sec));
}

/// Velocity [m/s] by which gusts carry the vehicle off the axis. The gusts measured in calm air are noise:
/// they move no vehicle, and hide real gusts of the same size.
double carryingMps(double gust_mps, double watched_sec) {
  const double beyond_calm_mps = std::sqrt(std::max(0.0, gust_mps * gust_mps - kCalmMps * kCalmMps) *
                                           (1.0 + kGustSec / std::max(watched_sec, kLeastWatchedSec)));
  return std::max(gust_mps, kStrongGustFactor * beyond_calm_mps);
}

double fullnessOf(double offset_m, double wall_m) {
  return wall_m > 0.0 && std::isfinite(offset_m) ? offset_m / wall_m
                                                 : std::numeric_limits<double>::infinity();
}

std::string whyUnmet(const CommitCriterion& criterion, const CommitCriterionInput& input,
                     const Eigen::Vector2d& offset_m) {
  constexpr const char* kWays[] = {"lateral", "vertical"};
  for (const int axis : {0, 1})
    if (!(std::abs(offset_m[axis]) < criterion.clearance_m[axis]))
      return formatted("%s offset %.2f m, clearance %.2f m", kWays[axis], offset_m[axis],
                       criterion.clearance_m[axis]);
  for (const int axis : {0, 1})
    if (!(criterion.miss_m[axis] < criterion.clearance_m[axis]))
      return formatted("predicted %s miss %.2f m in gusts of %.2f m/s, clearance %.2f m", kWays[axis],
                       criterion.miss_m[axis], input.gusts_mps[axis], criterion.clearance_m[axis]);
  if (!(criterion.settled_m.array() < criterion.clearance_m.array()).all())
    return formatted("carried off the axis: %.2f m to the side and %.2f m up or down at the plane",
                     criterion.settled_m.x(), criterion.settled_m.y());
  if (std::abs(input.relative.heading_error_rad) > kMaxHeadingErrorRad)
    return formatted("heading %.2f rad off the normal", input.relative.heading_error_rad);
  const double across_mps = input.relative.velocity_window_mps.tail<2>().norm();
  return across_mps > kMaxAcrossMps ? formatted("%.2f m/s across the normal", across_mps) : "";
}

}  // namespace

double commitDistance(const RelativeState& relative, const geometry::OpeningSize& opening, double pitch_rad,
                      const NavigatorParams& params) {
  const auto& vehicle = params.vehicle;
  const double speed_mps = std::max(params.commit.speed_mps, relative.velocity_window_mps.x());
  return std::max(viewDistance(relative, opening, pitch_rad, vehicle) + params.commit.view_margin_m,
                  vehicle.half_length_m + stoppingDistance(speed_mps, vehicle));
}

CommitCriterion evaluateCommitCriterion(const CommitCriterionInput& input, const NavigatorParams& params) {
  CommitCriterion criterion;
  const RelativeState& relative = input.relative;
  const VehicleParams& vehicle = params.vehicle;
  criterion.clearance_m = {input.opening.width_m / 2.0 - vehicle.half_width_m - vehicle.margin_m,
                           input.opening.height_m / 2.0 - vehicle.half_height_m - vehicle.margin_m};
  criterion.commit_distance_m = commitDistance(relative, input.opening, input.pitch_rad, params);

  // Time without sight of the window: so far, and until the plane.
  const double view_m = viewDistance(relative, input.opening, input.pitch_rad, vehicle);
  const double way_m = std::clamp(relative.distance(), 0.0, view_m);
  const double blind_sec = input.unseen_sec + way_m / params.commit.speed_mps;
  const double drift_m =
      std::max(vehicle.odom_drift_m_per_sqrt_sec, input.drift_m_per_sqrt_sec) * std::sqrt(blind_sec);
  // How long an unexpected velocity carries the vehicle off the axis: until it is answered and corrected.
  const double carried_sec = vehicle.response_sec + 1.0 / params.align.lateral_gain_hz;
  Eigen::Vector2d spread_m;
  for (const int axis : {0, 1}) {
    const double sigma_m = sigmaAhead(relative.sigma_m[axis], input.motion, blind_sec - input.unseen_sec);
    const double gust_m =
        kPartCarried * carried_sec * carryingMps(input.gusts_mps[axis], input.gusts_watched_sec);
    spread_m[axis] = params.approach.sigma_factor * std::hypot(sigma_m, drift_m, gust_m);
  }
  const double odometry_m = std::max(0.0, input.odometry_mps - kUsualOdometryMps) * carried_sec;
  const double left = remaining(relative, params);
  const Eigen::Vector2d offset_m = relative.coastedM(vehicle).tail<2>();
  criterion.miss_m = left * offset_m.cwiseAbs() + spread_m + Eigen::Vector2d::Constant(odometry_m);

  // Zero if the vehicle closes in on the axis as fast as it is steered; otherwise a steady disturbance keeps
  // it off the axis.
  const Eigen::Vector2d kept_m =
      offset_m + relative.velocity_window_mps.tail<2>() / params.align.lateral_gain_hz;
  criterion.settled_m = (kept_m + left * (offset_m - kept_m)).cwiseAbs();

  const double before_line_m = std::max(0.0, relative.distance() - criterion.commit_distance_m);
  criterion.funnel_m = params.approach.funnel_slope * before_line_m;
  for (const int axis : {0, 1})
    criterion.fullness =
        std::max(criterion.fullness, fullnessOf(std::abs(offset_m[axis]) + spread_m[axis],
                                                criterion.clearance_m[axis] + criterion.funnel_m));
  criterion.in_funnel = criterion.fullness < 1.0 && criterion.hasClearance();
  criterion.unmet = whyUnmet(criterion, input, offset_m);
  criterion.holds = criterion.unmet.empty();
  return criterion;
}

}  // namespace window_ingress::navigation
