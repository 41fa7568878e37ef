#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "simulation/random_stream.hpp"

namespace window_ingress::simulation {

inline constexpr double kFoot_m = 0.3048;
inline constexpr double kMinAirspeed_mps = 0.1;
const double kRoot3 = std::sqrt(3.0);

/// Strength and size of turbulence near the ground.
struct DrydenScale {
  Eigen::Vector3d sigma_mps;  ///< standard deviation along the wind, across it, up
  Eigen::Vector3d length_m;   ///< scale lengths
};

/// MIL-F-8785C, 3.7.3.4 (low altitude): L_w = h, L_u = L_v = h / (0.177 + 0.000823 h)^1.2 with h in feet,
/// sigma_w = 0.1 W20, sigma_u = sigma_v = sigma_w / (0.177 + 0.000823 h)^0.4. The model begins at 10 feet;
/// lower heights count as 10.
inline DrydenScale drydenScale(double height_m, double wind_20ft_mps) {
  const double height_ft = std::clamp(height_m / kFoot_m, 10.0, 1000.0);
  const double base = 0.177 + 0.000823 * height_ft;
  const double level_m = kFoot_m * height_ft / std::pow(base, 1.2);
  const double up_mps = 0.1 * wind_20ft_mps, level_mps = up_mps / std::pow(base, 0.4);
  return {{level_mps, level_mps, up_mps}, {level_m, level_m, kFoot_m * height_ft}};
}

/// Mean wind at a height, from the wind at 20 feet: the standard's logarithmic profile over short grass (z0 =
/// 0.15 feet), at least 3 feet [m/s].
inline double windAtHeight(double height_m, double wind_20ft_mps) {
  const double height_ft = std::max(height_m / kFoot_m, 3.0), roughness_ft = 0.15;
  return wind_20ft_mps * std::log(height_ft / roughness_ft) / std::log(20.0 / roughness_ft);
}

/// Dryden turbulence for a vehicle that moves through frozen air. Spectra, one-sided over the angular
/// frequency w, with T = L / airspeed:
///
///     u:     sigma^2 2 T / pi / (1 + (T w)^2)
///     v, w:  sigma^2 T / pi (1 + 3 (T w)^2) / (1 + (T w)^2)^2
///
/// White noise through the standard's filters, sampled exactly: the length of a step changes neither variance
/// nor correlation. Begins in the stationary state, not in calm air.
class DrydenGusts {
 public:
  explicit DrydenGusts(std::uint32_t seed) : random_(seed, "wind") {
    const double for_ever = std::numeric_limits<double>::max();
    along_ = random_.normal();
    across_.step(for_ever, random_);
    up_.step(for_ever, random_);
  }

  /// Gust along the mean wind, across it to the left, up [m/s].
  Eigen::Vector3d step(double step_sec, const DrydenScale& scale, double airspeed_mps) {
    const Eigen::Vector3d steps =
        step_sec * std::max(airspeed_mps, kMinAirspeed_mps) * scale.length_m.cwiseInverse();
    const double kept = std::exp(-steps.x());
    along_ = kept * along_ + random_.normal(std::sqrt(1.0 - kept * kept));
    across_.step(steps.y(), random_);
    up_.step(steps.z(), random_);
    return scale.sigma_mps.cwiseProduct(Eigen::Vector3d(along_, across_.output(), up_.output()));
  }

 private:
  // v or w, divided by its standard deviation: two first-order lags in series. The output is sqrt(3) times
  // the first plus (1 - sqrt(3)) times the second.
  struct Across {
    double first = 0.0, second = 0.0;
    // Transition exp(-s) [1 0; s 1] over s time constants. The noise restores the variance lost from the
    // stationary [1/2 1/4; 1/4 1/4].
    void step(double s, RandomStream& random) {
      const double kept = std::exp(-s), squared = kept * kept;
      const double lost = squared > 0.0 ? squared : 0.0, t = squared > 0.0 ? s : 0.0;
      const double q11 = 0.5 * (1.0 - lost);
      const double q12 = 0.25 - lost * (0.5 * t + 0.25);
      const double q22 = 0.25 - lost * (0.5 * t * t + 0.5 * t + 0.25);
      const double l11 = std::sqrt(q11), l21 = l11 > 0.0 ? q12 / l11 : 0.0;
      const double l22 = std::sqrt(std::max(0.0, q22 - l21 * l21));
      const double a = random.normal(), b = random.normal();
      second = kept * (t * first + second) + l21 * a + l22 * b;
      first = kept * first + l11 * a;
    }

    double output() const { return kRoot3 * first + (1.0 - kRoot3) * second; }
  };
  RandomStream random_;
  double along_ = 0.0;
  Across across_, up_;
};

}  // namespace window_ingress::simulation
