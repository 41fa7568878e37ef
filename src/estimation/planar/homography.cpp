#include "estimation/planar/homography.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "estimation/planar/relative_yaw.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation {
namespace {

geometry::Quadrilateral normalisedCorners(const RefinementProblem& problem) {
  geometry::Quadrilateral corners;
  for (int i = 0; i < 4; ++i)
    corners[i] = problem.camera.normalised(problem.image.cornersPx().segment<2>(2 * i));
  return corners;
}

// Deviation that scales the width alone by `factor`; zero if the prior does not allow it.
Eigen::Vector2d widened(const Eigen::Matrix2d& size_root, double factor) {
  const Eigen::Vector2d wanted(std::log(factor), 0.0);
  const Eigen::Matrix2d square = size_root.transpose() * size_root + 1e-12 * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d deviation = square.inverse() * size_root.transpose() * wanted;
  const bool reached = (size_root * deviation - wanted).norm() < 1e-6;
  return reached ? deviation : Eigen::Vector2d::Zero();
}

}  // namespace

std::optional<Eigen::Matrix3d> windowHomography(const geometry::Quadrilateral& corners_normalised,
                                                const geometry::OpeningSize& size) {
  if (!geometry::isFinite(corners_normalised)) return std::nullopt;
  // Normalises the plane by half sizes and the image about its centroid, because the equations are otherwise
  // ill-conditioned for a distant window.
  const Eigen::Vector2d centre = geometry::centroid(corners_normalised);
  double spread = 0.0;
  for (const auto& corner : corners_normalised) spread += 0.25 * (corner - centre).norm();
  if (!(spread > 1e-12)) return std::nullopt;

  const double plane_x[] = {-1, 1, 1, -1}, plane_y[] = {-1, -1, 1, 1};
  Eigen::Matrix<double, 8, 8> equations;
  Eigen::Matrix<double, 8, 1> image;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d p = (corners_normalised[i] - centre) / spread;
    const double x = plane_x[i], y = plane_y[i];
    equations.row(2 * i) << x, y, 1, 0, 0, 0, -p.x() * x, -p.x() * y;
    equations.row(2 * i + 1) << 0, 0, 0, x, y, 1, -p.y() * x, -p.y() * y;
    image.segment<2>(2 * i) = p;
  }
  const Eigen::FullPivLU<Eigen::Matrix<double, 8, 8>> lu(equations);
  if (lu.rcond() < 1e-9) return std::nullopt;
  const Eigen::Matrix<double, 8, 1> h = lu.solve(image);

  Eigen::Matrix3d local, to_image = Eigen::Matrix3d::Identity();
  local << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), 1.0;
  to_image.diagonal() << spread, spread, 1.0;
  to_image.topRightCorner<2, 1>() = centre;
  const Eigen::Vector3d to_half_sizes(2.0 / size.width_m, 2.0 / size.height_m, 1.0);
  const Eigen::Matrix3d homography = to_image * local * to_half_sizes.asDiagonal();
  const Eigen::Matrix3d unit = homography / homography.norm();
  if (!unit.allFinite() || std::abs(local.determinant()) < 1e-9) return std::nullopt;
  return homography;
}

std::optional<Eigen::Isometry3d> poseFromHomography(const Eigen::Matrix3d& homography) {
  const double length = 0.5 * (homography.col(0).norm() + homography.col(1).norm());
  if (!homography.allFinite() || !(length > 1e-12) || std::abs(homography(2, 2)) < 1e-12) return std::nullopt;
  Eigen::Matrix3d columns = homography * ((homography(2, 2) < 0.0 ? -1.0 : 1.0) / length);  // r1, r2, t
  const Eigen::Vector3d t = columns.col(2);
  columns.col(2) = columns.col(0).cross(columns.col(1));
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(columns, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d product = svd.matrixU() * svd.matrixV().transpose();
  const Eigen::Vector3d handedness(1, 1, product.determinant() < 0.0 ? -1 : 1);
  const Eigen::Matrix3d R = svd.matrixU() * handedness.asDiagonal() * svd.matrixV().transpose();
  // R_optical_flu turns the window's axes into the plane's (right, down, away), seen from the window.
  const Eigen::Isometry3d pose = geometry::makePose(R * geometry::R_optical_flu(), t);
  if (!geometry::isValidPose(pose)) return std::nullopt;
  return pose;
}

std::optional<FitPoint> startFromHomography(const RefinementProblem& problem) {
  auto homography = windowHomography(normalisedCorners(problem), problem.opening);
  if (!homography) return std::nullopt;
  const double correction = homography->col(0).norm() / homography->col(1).norm();  // 1 for the true size
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
