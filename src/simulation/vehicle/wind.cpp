#include "simulation/vehicle/wind.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::simulation {
namespace {

constexpr double kShelterDepth_m = 0.3;  // depth in the room at which the air is calmest
constexpr double kSoftEdge_m = 0.05, kJetSpread = 0.1, kCoreDiameters = 5.0, kDallaValle = 10.0;

// 1 within +-half, 0 beyond, with edges `soft_m` wide.
double within(double offset_m, double half_m, double soft_m) {
  return 0.5 * (1.0 + std::tanh((half_m - std::abs(offset_m)) / soft_m));
}

double smoothStep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

Wind::Wind(const WindParams& params, const WallInAir& wall, double vehicle_half_length_m, std::uint32_t seed)
    : params_(params),
      wall_(wall),
      vehicle_half_length_m_(vehicle_half_length_m),
      steady_mps_(params.x_mps, params.y_mps, params.z_mps),
      gusts_(seed) {}

double Wind::shelter(double x_m) const {
  const double deep = (x_m - wall_.front_x_m) / (wall_.back_x_m + kShelterDepth_m - wall_.front_x_m);
  return 1.0 - (1.0 - params_.inside_part) * smoothStep(deep);
}

double Wind::openAt(const Eigen::Vector3d& position_m, double soft_m) const {
  if (!wall_.open) return 0.0;
  return within(position_m.y(), 0.5 * wall_.opening.width_m, soft_m) *
         within(position_m.z(), 0.5 * wall_.opening.height_m, soft_m);
}

Eigen::Vector3d Wind::draughtAt(const Eigen::Vector3d& p) const {
  const double speed_mps = params_.draught_mps;
  if (speed_mps == 0.0 || !wall_.open) return Eigen::Vector3d::Zero();
  const double side = speed_mps > 0.0 ? 1.0 : -1.0;
  const double behind_m = side > 0.0 ? p.x() - wall_.back_x_m : -p.x();
  const double before_m = side > 0.0 ? -p.x() : p.x() - wall_.back_x_m;
  const double width_m = wall_.opening.width_m, height_m = wall_.opening.height_m;
  if (before_m <= 0.0) {
    const double core_m = kCoreDiameters * 2.0 * width_m * height_m / (width_m + height_m);
    const double downstream_m = std::max(behind_m, 0.0);
    const double left = core_m / std::max(core_m, downstream_m);
    return {speed_mps * left * openAt(p, kSoftEdge_m + kJetSpread * downstream_m), 0.0, 0.0};
  }
  const Eigen::Vector3d nearest(0.0, std::clamp(p.y(), -0.5 * width_m, 0.5 * width_m),
                                std::clamp(p.z(), -0.5 * height_m, 0.5 * height_m));
  const Eigen::Vector3d from(-side * before_m, p.y(), p.z());
  const double area_m2 = width_m * height_m;
  const double part = area_m2 / (area_m2 + kDallaValle * (nearest - from).squaredNorm());
  const double aside = 0.5 + 0.5 * part;  // straight at the opening, towards its middle from afar
  const Eigen::Vector3d sink(0.5 * side * std::sqrt(area_m2), aside * nearest.y(), aside * nearest.z());
  return std::abs(speed_mps) * part * (sink - from).normalized();
}

Eigen::Vector3d Wind::pushAt(const Eigen::Vector3d& p) const {
  if (params_.wall_push_mps2 == 0.0) return Eigen::Vector3d::Zero();
  const bool beside = std::abs(p.y()) > wall_.half_width_m || p.z() > wall_.top_z_m;
  const double front_gap_m = wall_.front_x_m - p.x() - vehicle_half_length_m_;
  const double back_gap_m = p.x() - vehicle_half_length_m_ - wall_.back_x_m;
  const double gap_m = std::max({front_gap_m, back_gap_m, 0.0});
  if (beside) return Eigen::Vector3d::Zero();
  const double size =
      params_.wall_push_mps2 * std::exp(-gap_m / params_.wall_push_length_m) * (1.0 - openAt(p, kSoftEdge_m));
  return {front_gap_m > back_gap_m ? size : -size, 0.0, 0.0};
}

Eigen::Vector3d Wind::steadyAt(const Eigen::Vector3d& position_m) const {
  return shelter(position_m.x()) * steady_mps_ + draughtAt(position_m);
}

Eigen::Vector3d Wind::gust(double step_sec, double height_m, const Eigen::Vector3d& velocity_mps) {
  if (params_.gusts == "none" || params_.wind_20ft_mps == 0.0) return Eigen::Vector3d::Zero();
  const double airspeed_mps =
      std::max((velocity_mps - steady_mps_).norm(), windAtHeight(height_m, params_.wind_20ft_mps));
  const Eigen::Vector3d gust =
      gusts_.step(step_sec, drydenScale(height_m, params_.wind_20ft_mps), airspeed_mps);
  const double level_mps = steady_mps_.head<2>().norm();
  const Eigen::Vector2d along =
      level_mps > 1e-6 ? Eigen::Vector2d(steady_mps_.head<2>() / level_mps) : Eigen::Vector2d(1.0, 0.0);
  return {gust.x() * along.x() - gust.y() * along.y(), gust.x() * along.y() + gust.y() * along.x(), gust.z()};
}

Air Wind::step(double step_sec, const Eigen::Vector3d& position_m, const Eigen::Vector3d& velocity_mps) {
  const Eigen::Vector3d gusts = gust(step_sec, position_m.z() - wall_.ground_z_m, velocity_mps);
  return {steadyAt(position_m) + shelter(position_m.x()) * gusts, pushAt(position_m)};
}

}  // namespace window_ingress::simulation
