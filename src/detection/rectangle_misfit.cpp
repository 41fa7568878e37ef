#include "window_ingress/detection/rectangle_misfit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace window_ingress::detection {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::PinholeCamera;
using geometry::Quadrilateral;
using Parameters = Eigen::Matrix<double, 7, 1>;  ///< turn, place, logarithm of the aspect over the expected
using Residuals = Eigen::Matrix<double, 9, 1>;

constexpr int kIterations = 12;
constexpr double kStartTurns_rad[] = {0.0, 0.8, -0.8};  ///< about the vertical, and about the horizontal
constexpr double kStep = 1e-6, kDamping = 1e-4;
constexpr double kNearest = 1e-3;  ///< a corner must lie before the camera, in heights of the rectangle

struct Problem {
  Quadrilateral corners;
  std::array<Matrix2d, 4> whitening;
  PinholeCamera camera;
  double aspect, log_aspect_sigma;

  /// Infinite where a corner lies behind the camera.
  Residuals residuals(const Matrix3d& start, const Parameters& p) const;
};

Matrix3d turned(const Matrix3d& start, const Vector3d& by) {
  const double angle = by.norm();
  return angle > 0.0 ? Matrix3d(Eigen::AngleAxisd(angle, by / angle) * start) : start;
}

Residuals Problem::residuals(const Matrix3d& start, const Parameters& p) const {
  const Matrix3d R = turned(start, p.head<3>());
  const double width = aspect * std::exp(p[6]);
  const Vector3d right = 0.5 * width * R.col(0), down = 0.5 * R.col(1), place = p.segment<3>(3);
  const std::array<Vector3d, 4> points = {Vector3d(place - right - down), Vector3d(place + right - down),
                                          Vector3d(place + right + down), Vector3d(place - right + down)};
  Residuals r;
  for (int i = 0; i < 4; ++i) {
    const Vector3d& q = points[i];
    if (!(q.z() > kNearest)) return Residuals::Constant(std::numeric_limits<double>::infinity());
    const Vector2d seen(camera.fx * q.x() / q.z() + camera.cx, camera.fy * q.y() / q.z() + camera.cy);
    r.segment<2>(2 * i) = whitening[i] * (seen - corners[i]);
  }
  r[8] = p[6] / log_aspect_sigma;
  return r;
}

// Levenberg and Marquardt; the sum of squares that is left.
double fitted(const Problem& problem, const Matrix3d& start, Parameters p) {
  Residuals r = problem.residuals(start, p);
  double left = r.squaredNorm(), damping = kDamping;
  for (int n = 0; n < kIterations && std::isfinite(left); ++n) {
    Eigen::Matrix<double, 9, 7> J;
    for (int k = 0; k < 7; ++k) {
      Parameters moved = p;
      moved[k] += kStep;
      J.col(k) = (problem.residuals(start, moved) - r) / kStep;
    }
    Eigen::Matrix<double, 7, 7> normal = J.transpose() * J;
    normal.diagonal() *= 1.0 + damping;
    const Parameters next = p - Parameters(normal.ldlt().solve(J.transpose() * r));
    const Residuals after = problem.residuals(start, next);
    const double now = after.squaredNorm();
    if (!(now < left)) {
      damping *= 10.0;
      continue;
    }
    const bool done = left - now < 1e-4 * left;
    p = next, r = after, left = now, damping *= 0.2;
    if (done) break;
  }
  return left;
}

// Upright along the upper side, facing the camera, then turned.
Matrix3d startTurn(const Quadrilateral& corners, const Vector3d& axis, double turn_rad) {
  const Vector2d along = corners[1] - corners[0] + corners[2] - corners[3];
  return Eigen::AngleAxisd(std::atan2(along.y(), along.x()), Vector3d::UnitZ()) *
         Eigen::AngleAxisd(turn_rad, axis).toRotationMatrix();
}

Parameters startPlace(const Quadrilateral& corners, const PinholeCamera& camera, double aspect) {
  const double depth = std::sqrt(aspect * camera.fx * camera.fy / std::abs(geometry::signedArea(corners)));
  const Vector2d middle = geometry::centroid(corners);
  Parameters p = Parameters::Zero();
  p.segment<3>(3) =
      depth * Vector3d((middle.x() - camera.cx) / camera.fx, (middle.y() - camera.cy) / camera.fy, 1.0);
  return p;
}

// Root of the inverse covariance.
Matrix2d whiteningOf(const Matrix2d& covariance, double least_px) {
  Matrix2d widened = 0.5 * (covariance + covariance.transpose());
  for (int k = 0; k < 2; ++k) widened(k, k) = std::max(widened(k, k), 0.0) + least_px * least_px;
  const Eigen::LLT<Matrix2d> root(widened);
  if (root.info() != Eigen::Success) return Matrix2d(Matrix2d::Identity() / std::sqrt(widened.trace()));
  return root.matrixL().solve(Matrix2d::Identity());
}

}  // namespace

std::optional<double> RectangleMisfit::of(const Quadrilateral& ideal,
                                          const std::array<Matrix2d, 4>& covariance,
                                          const PinholeCamera& camera) const {
  if (!geometry::isFinite(ideal) || !geometry::isConvex(ideal)) return std::nullopt;
  Problem problem{ideal, {}, camera, aspect, log_aspect_sigma};
  for (int i = 0; i < 4; ++i) {
    if (!covariance[i].allFinite()) return std::nullopt;
    problem.whitening[i] = whiteningOf(covariance[i], least_px);
  }
  const Parameters place = startPlace(ideal, camera, aspect);
  double least = std::numeric_limits<double>::infinity();
  for (double turn_rad : kStartTurns_rad)
    for (const Vector3d& axis : {Vector3d(Vector3d::UnitY()), Vector3d(Vector3d::UnitX())}) {
      if (turn_rad == 0.0 && axis.x() != 0.0) continue;
      least = std::min(least, fitted(problem, startTurn(ideal, axis, turn_rad), place));
    }
  if (!std::isfinite(least)) return std::nullopt;
  return std::sqrt(least);
}

}  // namespace window_ingress::detection
