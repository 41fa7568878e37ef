#include "simulation/scene/glass.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::simulation {
namespace {

constexpr double kRefractiveIndex = 1.52;

double square(double value) { return value * value; }

double ofBothFaces(double of_one) { return 2.0 * of_one / (1.0 + of_one); }

}  // namespace

double paneReflectance(double cos_incidence) {
  const double n = kRefractiveIndex, outside = std::clamp(cos_incidence, 0.0, 1.0);
  const double within = std::sqrt(1.0 - (1.0 - outside * outside) / (n * n));
  const double across = square((outside - n * within) / (outside + n * within));
  const double along = square((n * outside - within) / (n * outside + within));
  return 0.5 * (ofBothFaces(across) + ofBothFaces(along));
}

Eigen::Isometry3d mirrorAt(double x_m) {
  Eigen::Isometry3d mirror = Eigen::Isometry3d::Identity();
  mirror.linear()(0, 0) = -1.0;
  mirror.translation().x() = 2.0 * x_m;
  return mirror;
}

}  // namespace window_ingress::simulation
