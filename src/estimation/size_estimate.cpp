#include "window_ingress/estimation/size_estimate.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace window_ingress::estimation {

SizeEstimate sizeEstimate(const geometry::OpeningSize& size, double scale_sigma, double aspect_sigma) {
  const Eigen::Vector2d together(scale_sigma, scale_sigma), apart(0.5 * aspect_sigma, -0.5 * aspect_sigma);
  return {size, together * together.transpose() + apart * apart.transpose()};
}

bool isUsable(const SizeEstimate& belief) {
  const auto& [size, covariance] = belief;
  const bool has_size = std::isfinite(size.width_m + size.height_m) && size.width_m > 0 && size.height_m > 0;
  if (!has_size || !covariance.allFinite()) return false;
  const double size_of_it = covariance.norm(), allowed = 1e-9 * size_of_it;
  return covariance(0, 0) >= 0.0 && covariance(1, 1) >= 0.0 &&
         covariance.determinant() >= -allowed * size_of_it &&
         std::abs(covariance(0, 1) - covariance(1, 0)) <= allowed;
}

Eigen::Matrix2d rootOf(const SizeEstimate& belief) {
  if (belief.log_covariance.isZero(0.0)) return Eigen::Matrix2d::Zero();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(belief.log_covariance);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

geometry::OpeningSize scaled(const geometry::OpeningSize& size, const Eigen::Vector2d& log_deviation) {
  return {size.width_m * std::exp(log_deviation(0)), size.height_m * std::exp(log_deviation(1))};
}

}  // namespace window_ingress::estimation
