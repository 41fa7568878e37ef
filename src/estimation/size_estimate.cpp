#include "window_ingress/estimation/size_estimate.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "window_ingress/text/text.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kFitSigmas = 2.0;

struct Side {
  const char* name;
  double size_m, sigma_m, needed_m;
  double excess() const { return size_m - needed_m; }
};

std::string text(const Side& side, const char* relation) {
  return formatted("%s %.3f m +- %.3f %s %.3f m that are needed", side.name, side.size_m, side.sigma_m,
                   relation, side.needed_m);
}

}  // namespace

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

const char* toString(Fit fit) {
  constexpr const char* kNames[] = {"UNKNOWN", "GO", "NO_GO"};
  return kNames[static_cast<std::size_t>(fit)];
}

FitVerdict fitVerdict(const SizeEstimate& opening, const geometry::OpeningSize& needed) {
  if (!isUsable(opening)) return {Fit::kUnknown, "the size of the opening is not known"};
  const auto& [size, covariance] = opening;
  const Side width{"width", size.width_m, size.width_m * std::sqrt(covariance(0, 0)), needed.width_m};
  const Side height{"height", size.height_m, size.height_m * std::sqrt(covariance(1, 1)), needed.height_m};
  const Side& tighter = width.excess() < height.excess() ? width : height;
  for (const Side& side : {tighter, width, height})
    if (side.excess() < -kFitSigmas * side.sigma_m) return {Fit::kNoGo, text(side, "is less than the")};
  for (const Side& side : {tighter, width, height})
    if (!(side.excess() > kFitSigmas * side.sigma_m))
      return {Fit::kUnknown, text(side, "is not certain to be more or less than the")};
  return {Fit::kGo, text(tighter, "is more than the")};
}

}  // namespace window_ingress::estimation
