#include "simulation/surfaces/lighting.hpp"

#include <algorithm>

namespace window_ingress::simulation {

Eigen::Vector3d Lighting::brightness(const Eigen::Vector3d& normal, bool in_sun) const {
  const double sky = 1.0 + 0.08 * normal.z();
  const double soft = ambient * sky + lamp * std::max(0.0, normal.dot(towards_lamp));
  const double direct = in_sun ? sun * std::max(0.0, normal.dot(towards_sun)) : 0.0;
  return soft * soft_colour + direct * sun_colour;
}

bool Lighting::sunlit(const Eigen::Vector3d& point) const {
  const bool within = std::all_of(region.begin(), region.end(),
                                  [&](const HalfSpace& half) { return half.beyond(point) <= 0.0; });
  return within != shadow;
}

Lighting Lighting::inShadow() const {
  Lighting light = *this;
  light.sun = 0.0;
  return light;
}

}  // namespace window_ingress::simulation
