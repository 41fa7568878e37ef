#include "window_ingress/navigation/approach_contract.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace window_ingress::navigation {

double stoppingSpeed(double distance_m, double braking_mps2, double response_sec) {
  if (!(distance_m > 0.0)) return 0.0;
  return braking_mps2 *
         (std::sqrt(response_sec * response_sec + 2.0 * distance_m / braking_mps2) - response_sec);
}

double stoppingDistance(double speed_mps, double braking_mps2, double response_sec) {
  return std::abs(speed_mps) * response_sec + speed_mps * speed_mps / (2.0 * braking_mps2);
}

double commitDistance(const RelativeState& relative, const geometry::OpeningSize& opening, double pitch_rad,
                      const NavigatorParams& params) {
  const auto& vehicle = params.vehicle;
  const double half_v_rad = std::max(0.1, vehicle.vertical_fov_rad / 2.0 - std::abs(pitch_rad));
  const double wide_m = opening.width_m / 2.0 + std::abs(relative.lateral());
  const double high_m = opening.height_m / 2.0 + std::abs(relative.vertical());
  const double view_m =
      std::max(wide_m / std::tan(vehicle.horizontal_fov_rad / 2.0), high_m / std::tan(half_v_rad));
  const double stop_m = stoppingDistance(params.commit.speed_mps, vehicle.braking_mps2, vehicle.response_sec);
  return std::max(view_m + vehicle.camera_forward_m + params.commit.view_margin_m,
                  vehicle.half_length_m + stop_m);
}

namespace {

/// The way without sight: at most from the commit line until the tail has left the opening's front plane.
double blindSec(const RelativeState& relative, double commit_distance_m, const NavigatorParams& params) {
  const double way_m =
      std::min(std::max(relative.distance(), 0.0), commit_distance_m) + params.vehicle.half_length_m;
  return way_m / params.commit.speed_mps;
}

double missOf(double offset_m, double speed_mps, double sigma_m, double blind_sec,
              const NavigatorParams& params) {
  return std::abs(offset_m + speed_mps * params.vehicle.response_sec) +
         params.approach.sigma_factor * sigma_m + params.commit.drift_mps * blind_sec;
}

double opennessOf(double miss_m, double wall_m) {
  return wall_m > 0.0 && std::isfinite(miss_m) ? std::clamp((wall_m - miss_m) / (0.35 * wall_m), 0.0, 1.0)
                                               : 0.0;
}

template <typename... Args>
std::string format(const char* pattern, Args... args) {
  char text[160];
  std::snprintf(text, sizeof text, pattern, args...);
  return text;
}

std::string whyUnmet(const Contract& contract, const RelativeState& relative, const NavigatorParams& params) {
  if (!(contract.miss_lateral_m < contract.clearance_lateral_m)) {
    return format("predicted lateral miss %.2f m, clearance %.2f m", contract.miss_lateral_m,
                  contract.clearance_lateral_m);
  }
  if (!(contract.miss_vertical_m < contract.clearance_vertical_m)) {
    return format("predicted vertical miss %.2f m, clearance %.2f m", contract.miss_vertical_m,
                  contract.clearance_vertical_m);
  }
  if (std::abs(relative.heading_error_rad) > params.commit.max_heading_error_rad) {
    return format("heading %.2f rad off the normal", relative.heading_error_rad);
  }
  const double across_mps = relative.velocity_window_mps.tail<2>().norm();
  if (across_mps > params.commit.max_lateral_speed_mps)
    return format("%.2f m/s across the normal", across_mps);
  return "";
}

}  // namespace

Contract evaluateContract(const RelativeState& relative, const geometry::OpeningSize& opening,
                          double pitch_rad, const NavigatorParams& params) {
  Contract contract;
  const Eigen::Vector3d& velocity = relative.velocity_window_mps;
  const double margin_m = params.approach.margin_m;
  contract.clearance_lateral_m = opening.width_m / 2.0 - params.vehicle.half_width_m - margin_m;
  contract.clearance_vertical_m = opening.height_m / 2.0 - params.vehicle.half_height_m - margin_m;
  contract.commit_distance_m = commitDistance(relative, opening, pitch_rad, params);
  const double blind_sec = blindSec(relative, contract.commit_distance_m, params);
  contract.miss_lateral_m =
      missOf(relative.lateral(), velocity.y(), relative.sigma_lateral_m, blind_sec, params);
  contract.miss_vertical_m =
      missOf(relative.vertical(), velocity.z(), relative.sigma_vertical_m, blind_sec, params);

  const double before_line_m = std::max(0.0, relative.distance() - contract.commit_distance_m);
  contract.funnel_m = params.approach.funnel_slope * before_line_m;
  contract.openness =
      std::min(opennessOf(contract.miss_lateral_m, contract.clearance_lateral_m + contract.funnel_m),
               opennessOf(contract.miss_vertical_m, contract.clearance_vertical_m + contract.funnel_m));
  contract.in_funnel =
      contract.openness > 0.0 && contract.clearance_lateral_m > 0.0 && contract.clearance_vertical_m > 0.0;
  contract.unmet = whyUnmet(contract, relative, params);
  contract.holds = contract.unmet.empty();
  return contract;
}

}  // namespace window_ingress::navigation
