#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "simulation/random_stream.hpp"

namespace window_ingress::simulation {

/// Strength and size of turbulence near the ground.
struct DrydenScale {
  Eigen::Vector3d sigma_mps;  ///< standard deviation along the wind, across it, up
  Eigen::Vector3d length_m;   ///< scale lengths
};

/// MIL-F-8785C, 3.7.3.4 (low altitude): L_w = h, L_u = L_v = h / (0.177 + 0.000823 h)^1.2 with h in feet,
/// sigma_w = 0.1 W20, sigma_u = sigma_v = sigma_w / (0.177 + 0.000823 h)^0.4. It begins at 10 feet: lower
/// heights count as that.
DrydenScale drydenScale(double height_m, double wind_20ft_mps);

/// Mean wind at a height, from that at 20 feet: the standard's logarithmic profile over short grass
/// (z0 = 0.15 feet), 3 feet at least [m/s].
double windAtHeight(double height_m, double wind_20ft_mps);

/// Dryden turbulence as a vehicle meets it that moves through frozen air: spectra, one-sided over the angular
/// frequency w, with T = L / airspeed,
///
///     u:     sigma^2 2 T / pi / (1 + (T w)^2)
///     v, w:  sigma^2 T / pi (1 + 3 (T w)^2) / (1 + (T w)^2)^2
///
/// White noise through the standard's filters, sampled exactly: the step's length changes neither variance
/// nor correlation. Begins in the middle of it, not in calm.
class DrydenGusts {
 public:
  explicit DrydenGusts(std::uint32_t seed);
  /// Gust along the mean wind, across it to the left, up [m/s].
  Eigen::Vector3d step(double step_sec, const DrydenScale& scale, double airspeed_mps);

 private:
  // v or w over its standard deviation: two first-order lags in a row, of which the output takes
  // sqrt(3) times the first and (1 - sqrt(3)) times the second.
  struct Across {
    double first = 0.0, second = 0.0;
    void step(double steps, RandomStream& random);
    double output() const;
  };
  RandomStream random_;
  double along_ = 0.0;
  Across across_, up_;
};

}  // namespace window_ingress::simulation
