#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace window_ingress::evaluation {

struct Interval {
  double low = 0.0;
  double high = 1.0;
};

/// Wilson score interval of a rate, 95 % (z = 1.96). Without trials it is [0, 1].
inline Interval wilson95(int successes, int trials) {
  if (trials <= 0) return {};
  const double z = 1.959964, n = trials, p = successes / n;
  const double centre = p + z * z / (2 * n);
  const double spread = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  const double scale = 1 + z * z / n;
  return {std::max(0.0, (centre - spread) / scale), std::min(1.0, (centre + spread) / scale)};
}

/// Value below which the given fraction (0 to 1) of the values lies, linear between neighbours; 0 if there
/// are none.
inline double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double position = std::clamp(fraction, 0.0, 1.0) * (values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (position - below) * (values[above] - values[below]);
}

/// Mean; 0 of no values.
inline double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / std::max<std::size_t>(1, values.size());
}

/// Root of the mean square; 0 of no values.
inline double rms(const std::vector<double>& values) {
  const double squares = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  return std::sqrt(squares / std::max<std::size_t>(1, values.size()));
}

}  // namespace window_ingress::evaluation
