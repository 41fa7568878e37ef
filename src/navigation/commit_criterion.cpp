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
  const double half_v_rad = std::max(0.1, vehicle.vertical_fov_rad / 2.0 - std::abs(pitch_rad));
  const double half_width_m = opening.width_m / 2.0, half_height_m = opening.height_m / 2.0;
  const double wide_m = half_width_m + std::min(std::abs(relative.lateral()), half_width_m);
  const double high_m = half_height_m + std::min(std::abs(relative.vertical()), half_height_m);
  return std::max(wide_m / std::tan(vehicle.horizontal_fov_rad / 2.0), high_m / std::tan(half_v_rad)) +
         vehicle.camera_forward_m;
}

}  // namespace

double commitDistance(const RelativeState& relative, const geometry::OpeningSize& opening, double pitch_rad,
                      const NavigatorParams& params) {
  const auto& vehicle = params.vehicle;
  const double speed_mps = std::max(params.commit.speed_mps, relative.velocity_window_mps.x());
  const double stop_m = stoppingDistance(speed_mps, vehicle);
  return std::max(viewDistance(relative, opening, pitch_rad, vehicle) + params.commit.view_margin_m,
                  vehicle.half_length_m + stop_m);
}

namespace {

/// Time without sight of the window: so far, and until the plane.
double blindSec(const CommitCriterionInput& input, const NavigatorParams& params) {
  const double view_m = viewDistance(input.relative, input.opening, input.pitch_rad, params.vehicle);
  const double way_m = std::clamp(input.relative.distance(), 0.0, view_m);
  return input.unseen_sec + way_m / params.commit.speed_mps;
}

/// Where the vehicle is after its response time.
Eigen::Vector3d coastedOffset(const RelativeState& relative, const NavigatorParams& params) {
  return relative.position_window_m +
         relative.velocity_window_mps.cwiseProduct(params.vehicle.responsesSec());
}

/// Fraction of an offset that remains when the nose reaches the opening, after steering with a delay.
double remaining(const RelativeState& relative, const NavigatorParams& params) {
  const double way_m = relative.distance() - params.vehicle.half_length_m;
  const double steering_sec = way_m / params.commit.speed_mps - params.vehicle.response_sec;
  return std::exp(-params.align.lateral_gain_hz * std::max(0.0, steering_sec));
}

/// Offset at the plane if the measured velocity beyond what steering asks for persists. Zero if the vehicle
/// closes in on the axis as fast as it is steered; otherwise a steady disturbance keeps it off the axis.
Eigen::Vector3d settled(const RelativeState& relative, const NavigatorParams& params) {
  const Eigen::Vector3d offset = coastedOffset(relative, params);
  const Eigen::Vector3d kept = offset + relative.velocity_window_mps / params.align.lateral_gain_hz;
  return kept + remaining(relative, params) * (offset - kept);
}

/// How long an unexpected velocity carries the vehicle off the axis: until it is answered and corrected.
double carriedSec(const NavigatorParams& params) {
  return params.vehicle.response_sec + 1.0 / params.align.lateral_gain_hz;
}

double missByOdometry(double odometry_mps, const NavigatorParams& params) {
  return std::max(0.0, odometry_mps - kUsualOdometryMps) * carriedSec(params);
}

/// How far gusts carry the vehicle off the axis. The gusts measured in calm air are noise: they move no
/// vehicle, and hide real gusts of the same size.
double carriedM(double gust_mps, double watched_sec, const NavigatorParams& params) {
  const double beyond_calm_mps = std::sqrt(std::max(0.0, gust_mps * gust_mps - kCalmMps * kCalmMps) *
                                           (1.0 + kGustSec / std::max(watched_sec, kLeastWatchedSec)));
  return kPartCarried * carriedSec(params) * std::max(gust_mps, kStrongGustFactor * beyond_calm_mps);
}

/// Random part of the miss: `sigma_factor` standard deviations.
double spreadOf(double sigma_m, double gust_m, double drift_m, const NavigatorParams& params) {
  return params.approach.sigma_factor * std::hypot(sigma_m, drift_m, gust_m);
}

double fullnessOf(double offset_m, double wall_m) {
  return wall_m > 0.0 && std::isfinite(offset_m) ? offset_m / wall_m
                                                 : std::numeric_limits<double>::infinity();
}

std::string predictedMiss(const char* way, double miss_m, double clearance_m, double gust_mps) {
  return formatted("predicted %s miss %.2f m in gusts of %.2f m/s, clearance %.2f m", way, miss_m, gust_mps,
                   clearance_m);
}

std::string whyUnmet(const CommitCriterion& criterion, const CommitCriterionInput& input,
                     const NavigatorParams& params) {
  const RelativeState& relative = input.relative;
  const Eigen::Vector3d coasted = coastedOffset(relative, params);
  if (!(std::abs(coasted.y()) < criterion.clearance_lateral_m)) {
    return formatted("lateral offset %.2f m, clearance %.2f m", coasted.y(), criterion.clearance_lateral_m);
  }
  if (!(std::abs(coasted.z()) < criterion.clearance_vertical_m)) {
    return formatted("vertical offset %.2f m, clearance %.2f m", coasted.z(), criterion.clearance_vertical_m);
  }
  if (!(criterion.miss_lateral_m < criterion.clearance_lateral_m))
    return predictedMiss("lateral", criterion.miss_lateral_m, criterion.clearance_lateral_m,
                         input.gust_lateral_mps);
  if (!(criterion.miss_vertical_m < criterion.clearance_vertical_m))
    return predictedMiss("vertical", criterion.miss_vertical_m, criterion.clearance_vertical_m,
                         input.gust_vertical_mps);
  if (!(criterion.settled_lateral_m < criterion.clearance_lateral_m) ||
      !(criterion.settled_vertical_m < criterion.clearance_vertical_m))
    return formatted("carried off the axis: %.2f m to the side and %.2f m up or down at the plane",
                     criterion.settled_lateral_m, criterion.settled_vertical_m);
  if (std::abs(relative.heading_error_rad) > kMaxHeadingErrorRad) {
    return formatted("heading %.2f rad off the normal", relative.heading_error_rad);
  }
  const double across_mps = relative.velocity_window_mps.tail<2>().norm();
  if (across_mps > kMaxAcrossMps) return formatted("%.2f m/s across the normal", across_mps);
  return "";
}

}  // namespace

CommitCriterion evaluateCommitCriterion(const CommitCriterionInput& input, const NavigatorParams& params) {
  CommitCriterion criterion;
  const RelativeState& relative = input.relative;
  const double margin_m = params.vehicle.margin_m;
  criterion.clearance_lateral_m = input.opening.width_m / 2.0 - params.vehicle.half_width_m - margin_m;
  criterion.clearance_vertical_m = input.opening.height_m / 2.0 - params.vehicle.half_height_m - margin_m;
  criterion.commit_distance_m = commitDistance(relative, input.opening, input.pitch_rad, params);
  const double blind_sec = blindSec(input, params);
  const double way_sec = blind_sec - input.unseen_sec;
  const auto atPlane = [&](double sigma_m) { return sigmaAhead(sigma_m, input.motion, way_sec); };
  const double drift_m =
      std::max(params.vehicle.odom_drift_m_per_sqrt_sec, input.drift_m_per_sqrt_sec) * std::sqrt(blind_sec);
  const auto carried = [&](double gust_mps) { return carriedM(gust_mps, input.gusts_watched_sec, params); };
  const double lateral_m =
      spreadOf(atPlane(relative.sigma_lateral_m), carried(input.gust_lateral_mps), drift_m, params);
  const double vertical_m =
      spreadOf(atPlane(relative.sigma_vertical_m), carried(input.gust_vertical_mps), drift_m, params);
  const Eigen::Vector3d offset = coastedOffset(relative, params).cwiseAbs();
  const double left = remaining(relative, params);
  const double odometry_m = missByOdometry(input.odometry_mps, params);
  criterion.miss_lateral_m = left * offset.y() + lateral_m + odometry_m;
  criterion.miss_vertical_m = left * offset.z() + vertical_m + odometry_m;

  const Eigen::Vector3d settled_m = settled(relative, params).cwiseAbs();
  criterion.settled_lateral_m = settled_m.y();
  criterion.settled_vertical_m = settled_m.z();

  const double before_line_m = std::max(0.0, relative.distance() - criterion.commit_distance_m);
  criterion.funnel_m = params.approach.funnel_slope * before_line_m;
  criterion.fullness =
      std::max(fullnessOf(offset.y() + lateral_m, criterion.clearance_lateral_m + criterion.funnel_m),
               fullnessOf(offset.z() + vertical_m, criterion.clearance_vertical_m + criterion.funnel_m));
  criterion.in_funnel =
      criterion.fullness < 1.0 && criterion.clearance_lateral_m > 0.0 && criterion.clearance_vertical_m > 0.0;
  criterion.unmet = whyUnmet(criterion, input, params);
  criterion.holds = criterion.unmet.empty();
  return criterion;
}

}  // namespace window_ingress::navigation
