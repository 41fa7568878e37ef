#include <cmath>

#include "simulation/scene/scene_parts.hpp"

namespace window_ingress::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kGrazing = 0.02;  // with a smaller angle to the wall, sunlight does not enter
constexpr double kPaneTransmission = 0.85;

Vector3d factors(const ColourParams& colour) { return Vector3d(colour.r, colour.g, colour.b) / 255.0; }

Vector3d towardsSun(const HouseParams& house) {
  const double level = std::cos(house.daylight.sun_elevation_rad);
  return {-level * std::cos(house.daylight.sun_azimuth_rad), level * std::sin(house.daylight.sun_azimuth_rad),
          std::sin(house.daylight.sun_elevation_rad)};
}

// Restricts `region` to where the sun shines through a hole in the plane `x_m`.
void addBeam(std::vector<HalfSpace>& region, double x_m, const Rectangle& hole, const Vector3d& sun) {
  const double aside = sun.y() / sun.x(), up = sun.z() / sun.x();  // slope of the sun's ray, per metre of x
  region.push_back({Vector3d(-aside, 1, 0), hole.left_m - aside * x_m});
  region.push_back({Vector3d(aside, -1, 0), aside * x_m - hole.right_m});
  region.push_back({Vector3d(-up, 0, 1), hole.top_m - up * x_m});
  region.push_back({Vector3d(up, 0, -1), up * x_m - hole.bottom_m});
}

// The house's shadow on the ground in front, with the sun behind the house.
std::vector<HalfSpace> houseShadow(const Scenario& scenario, const Vector3d& sun) {
  std::vector<HalfSpace> region;
  Rectangle house = frontWall(scenario);
  const double middle_m = 0.5 * (scenario.house.wall_thickness_m + scenario.house.room_depth_m);
  house.bottom_m -= 100.0;
  house.top_m += 0.45 * middle_m;
  addBeam(region, middle_m, house, sun);
  region.push_back({Vector3d::UnitX(), middle_m});
  return region;
}

// Empty if no sun enters the room.
std::vector<HalfSpace> sunInRoom(const Scenario& scenario, const Vector3d& sun) {
  std::vector<HalfSpace> region;
  const double front_m = scenario.window.wallFront() + scenario.house.wall_thickness_m;
  if (sun.x() < -kGrazing && scenario.window.showsRoom()) {
    region = revealLight(scenario, targetOpening(scenario), 0.0).region;
    addBeam(region, front_m, targetOpening(scenario), sun);
  } else if (sun.x() > kGrazing && scenario.house.back_window) {
    addBeam(region, front_m + scenario.house.room_depth_m, backWindow(scenario), sun);
  }
  return region;
}

}  // namespace

double eavesShadow(const Scenario& scenario, double x_m) {
  const Vector3d sun = towardsSun(scenario.house);
  const double top_m = frontWall(scenario).top_m;
  if (sun.x() > -kGrazing) return top_m - 100.0;
  return top_m + (kOverhang_m + x_m) * sun.z() / sun.x();
}

Lighting daylight(const Scenario& scenario) {
  const HouseParams& house = scenario.house;
  Lighting light{towardsSun(house), house.daylight.sun, house.daylight.ambient};
  light.sun_colour = light.soft_colour = factors(house.daylight.light);
  if (light.towards_sun.x() > kGrazing) {
    light.region = houseShadow(scenario, light.towards_sun);
    light.shadow = true;
  }
  return light;
}

Lighting revealLight(const Scenario& scenario, const Rectangle& opening, double x_m) {
  Lighting light = daylight(scenario);
  if (light.towards_sun.x() > -kGrazing) return light.inShadow();
  const double shadow_m = eavesShadow(scenario, x_m);
  Rectangle lit = opening;
  lit.top_m = std::min(lit.top_m, shadow_m);
  if (lit.top_m <= lit.bottom_m) return light.inShadow();
  addBeam(light.region, x_m, lit, light.towards_sun);
  return light;
}

Lighting roomLight(const Scenario& scenario) {
  const double level = scenario.house.room_light;
  Lighting light{towardsSun(scenario.house), scenario.house.daylight.sun, 0.75 * level,
                 Vector3d(-0.8, 0.25, 0.55).normalized(), 0.5 * level};
  light.sun_colour = factors(scenario.house.daylight.light);
  light.region = sunInRoom(scenario, light.towards_sun);
  if (light.region.empty()) return light.inShadow();
  if (light.towards_sun.x() > 0.0 || !scenario.window.isOpen()) light.sun *= kPaneTransmission;
  return light;
}

Lighting skyLight(const Scenario& scenario) {
  Lighting light{Vector3d::UnitZ(), 0.0, scenario.house.daylight.sky};
  light.soft_colour = factors(scenario.house.daylight.light);
  return light;
}

std::optional<Fog> fogOf(const Scenario& scenario) {
  const HouseParams& house = scenario.house;
  if (house.daylight.fog_m <= 0.0) return std::nullopt;
  const Vector3d white = Vector3d(0.80, 0.82, 0.84) * house.daylight.sky;
  return Fog{white.cwiseProduct(factors(house.daylight.light)).cwiseMin(1.0),
             -std::log(0.05) / house.daylight.fog_m};
}

}  // namespace window_ingress::simulation
