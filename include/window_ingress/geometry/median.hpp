#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <vector>

namespace window_ingress::geometry {

/// The middle value, the upper one of two; `values` are reordered and must not be empty.
template <typename Value, typename Less = std::less<Value>>
Value median(std::vector<Value>& values, Less less = Less()) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end(), less);
  return *middle;
}

/// The median of each component.
inline Eigen::Vector3d componentwiseMedian(std::vector<Eigen::Vector3d>& values) {
  Eigen::Vector3d result;
  for (int axis = 0; axis < 3; ++axis)
    result[axis] = median(values, [axis](const auto& a, const auto& b) { return a[axis] < b[axis]; })[axis];
  return result;
}

}  // namespace window_ingress::geometry
