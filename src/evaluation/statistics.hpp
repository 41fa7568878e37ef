#pragma once

#include <vector>

namespace window_ingress::evaluation {

struct Interval {
  double low = 0.0;
  double high = 1.0;
};

/// Wilson score interval of a rate, 95 % (z = 1.96). Without trials it is [0, 1].
Interval wilson95(int successes, int trials);

/// Value below which the given fraction (0 to 1) of the values lies, linear between neighbours; 0 if there
/// are none.
double quantile(std::vector<double> values, double fraction);

}  // namespace window_ingress::evaluation
