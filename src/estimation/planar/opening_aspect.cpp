#include "estimation/planar/opening_aspect.hpp"

#include <Eigen/LU>
#include <cmath>

#include "estimation/planar/homography.hpp"
#include "estimation/planar/relative_yaw.hpp"

namespace window_ingress::estimation {
namespace {

geometry::Quadrilateral normalisedCorners(const RefinementProblem& problem) {
  geometry::Quadrilateral corners;
  const auto& camera = problem.camera;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d pixel = problem.image.cornersPx().segment<2>(2 * i);
    corners[i] = {(pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy};
  }
  return corners;
}

// Deviation by which the width alone becomes `factor` times as large; zero if the belief does not allow it.
Eigen::Vector2d widened(const Eigen::Matrix2d& size_root, double factor) {
  const Eigen::Vector2d wanted(std::log(factor), 0.0);
  const Eigen::Matrix2d square = size_root.transpose() * size_root + 1e-12 * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d deviation = square.inverse() * size_root.transpose() * wanted;
  const bool reached = (size_root * deviation - wanted).norm() < 1e-6;
  return reached ? deviation : Eigen::Vector2d::Zero();
}

}  // namespace

double aspectCorrection(const Eigen::Matrix3d& homography) {
  return homography.col(0).norm() / homography.col(1).norm();
}

std::optional<FitPoint> startFromHomography(const RefinementProblem& problem) {
  auto homography = windowHomography(normalisedCorners(problem), problem.opening);
  if (!homography) return std::nullopt;
  const double correction = aspectCorrection(*homography);
  const bool usable = std::isfinite(correction) && correction > 1e-3 && correction < 1e3;
  const Eigen::Vector2d deviation = usable ? widened(problem.size_root, correction) : Eigen::Vector2d::Zero();
  if (!deviation.isZero(0.0)) homography->col(0) /= correction;
  const auto pose = poseFromHomography(*homography);
  if (!pose) return std::nullopt;
  return FitPoint{*pose, deviation};
}

std::optional<MeasuredAspect> measureAspect(const RefinementProblem& problem) {
  const RefinementProblem free = withFreeWidth(problem);
  const auto start = startFromHomography(free);
  if (!start) return std::nullopt;
  const auto fit = refine(free, *start);
  if (!fit) return std::nullopt;
  const double ratio = fit->opening.width_m / fit->opening.height_m;
  const double sigma = ratio * std::sqrt(fit->opening_log_covariance(0, 0));
  if (!std::isfinite(ratio + sigma)) return std::nullopt;
  return MeasuredAspect{ratio, sigma};
}

}  // namespace window_ingress::estimation
