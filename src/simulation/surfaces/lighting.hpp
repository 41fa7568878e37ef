#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace window_ingress::simulation {

/// All points p with normal . p <= offset.
struct HalfSpace {
  Eigen::Vector3d normal;
  double offset;
  double beyond(const Eigen::Vector3d& point) const { return normal.dot(point) - offset; }
};

/// The sun, light from everywhere, and a soft light from one side; brightness of a face by its normal.
struct Lighting {
  Eigen::Vector3d towards_sun = Eigen::Vector3d::UnitZ();
  double sun = 0.5;
  double ambient = 0.5;
  Eigen::Vector3d towards_lamp = Eigen::Vector3d::UnitZ();
  double lamp = 0.0;
  Eigen::Vector3d sun_colour = Eigen::Vector3d::Ones();   ///< of the sun
  Eigen::Vector3d soft_colour = Eigen::Vector3d::Ones();  ///< of all other light
  /// Convex part of space: where all of these hold there is sun (or there is none, with `shadow`), elsewhere
  /// it is the other way round. Empty: sun everywhere.
  std::vector<HalfSpace> region = {};
  bool shadow = false;

  /// Each channel, for a face in the sun or in the shadow.
  Eigen::Vector3d brightness(const Eigen::Vector3d& normal, bool in_sun) const {
    const double sky = 1.0 + 0.08 * normal.z();
    const double soft = ambient * sky + lamp * std::max(0.0, normal.dot(towards_lamp));
    const double direct = in_sun ? sun * std::max(0.0, normal.dot(towards_sun)) : 0.0;
    return soft * soft_colour + direct * sun_colour;
  }

  /// The sun reaches faces with this normal.
  bool reaches(const Eigen::Vector3d& normal) const { return sun > 0.0 && normal.dot(towards_sun) > 0.0; }
  bool sunlit(const Eigen::Vector3d& point) const {
    const bool within = std::all_of(region.begin(), region.end(),
                                    [&](const HalfSpace& half) { return half.beyond(point) <= 0.0; });
    return within != shadow;
  }

  /// The same without the sun.
  Lighting inShadow() const {
    Lighting light = *this;
    light.sun = 0.0;
    return light;
  }
};

}  // namespace window_ingress::simulation
