#include "detection/tracking/quad_motion.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

using Vector8d = QuadMotion::Vector8d;
using Matrix8d = QuadMotion::Matrix8d;

constexpr double kMinSigmaPx = 0.05;
constexpr double kGain = 0.5;           // correction of the velocity by the prediction's error
constexpr double kUnknownMotion = 3.0;  // factor of the first prediction's spread, without velocity

Vector8d asVector(const geometry::Quadrilateral& quad) {
  Vector8d vector;
  vector << quad[0], quad[1], quad[2], quad[3];
  return vector;
}

// Columns: corner movements of about one pixel, for each kind of change.
Matrix8d kindsOfChange(const geometry::Quadrilateral& quad) {
  const Vector2d centre = geometry::centroid(quad);
  double size = 1e-9;
  for (const Vector2d& p : quad) size += 0.25 * (p - centre).norm();
  Matrix8d kinds;
  for (int i = 0; i < 4; ++i) {
    const Vector2d r = (quad[i] - centre) / size;
    kinds.block<2, 8>(2 * i, 0) << 1, 0, r.x(), -r.y(), r.x(), r.y(), r.x() * r.x(), r.x() * r.y(),  //
        0, 1, r.y(), r.x(), -r.y(), r.x(), r.x() * r.y(), r.y() * r.y();
  }
  return kinds;
}

Matrix8d covarianceOf(const geometry::Quadrilateral& quad, const QuadSpread& spread) {
  Vector8d sigmas;
  sigmas << spread.place_px, spread.place_px, spread.reshape_px, spread.reshape_px, spread.warp_px,
      spread.warp_px, spread.warp_px, spread.warp_px;
  const Matrix8d scaled = kindsOfChange(quad) * sigmas.asDiagonal();
  return scaled * scaled.transpose();
}

}  // namespace

void QuadMotion::start(const geometry::Quadrilateral& quad, double sigma_px) {
  corners_ = asVector(quad);
  predicted_ = quad;
  velocity_.setZero();
  has_velocity_ = false;
  covariance_ = Matrix8d::Identity() * std::max(kMinSigmaPx, sigma_px) * std::max(kMinSigmaPx, sigma_px);
}

void QuadMotion::predict(const Eigen::Matrix3d& turn, double elapsed_sec, const QuadSpread& spread) {
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = turn * corner(i).homogeneous();
    if (p.z() > 1e-6) corners_.segment<2>(2 * i) = p.hnormalized();
  }
  corners_ += elapsed_sec * velocity_;
  predicted_ = quad();
  const double factor = has_velocity_ ? 1.0 : kUnknownMotion;
  covariance_ += covarianceOf(
      predicted_, {factor * spread.place_px, factor * spread.reshape_px, factor * spread.warp_px});
}

void QuadMotion::correct(int side, const Line& line) {
  // By its offset at the line's point.
  const Vector2d from = corner(side), span = corner(side + 1) - from;
  const double t = (line.point - from).dot(span) / std::max(1.0, span.squaredNorm());
  correct(side, (1.0 - t) * line.normal, t * line.normal, -line.distance(from + t * span),
          std::max(kMinSigmaPx, line.sigma_px));
  // By its direction.
  const Vector2d turned = corner(side + 1) - corner(side);
  const double length = std::max(1.0, turned.norm());
  correct(side, -line.normal / length, line.normal / length, -line.normal.dot(turned) / length,
          std::max(kMinSigmaPx / length, line.sigma_rad));
}

void QuadMotion::correct(int side, const Vector2d& from, const Vector2d& to, double rest, double sigma) {
  Vector8d weights = Vector8d::Zero();
  weights.segment<2>(2 * side) = from;
  weights.segment<2>(2 * ((side + 1) % 4)) = to;
  const Vector8d spread = covariance_ * weights;
  const double variance = weights.dot(spread) + std::pow(sigma, 2);
  corners_ += spread * (rest / variance);
  covariance_ -= spread * spread.transpose() / variance;
}

void QuadMotion::settle(double elapsed_sec) {
  if (!(elapsed_sec > 1e-4)) return;
  const double gain = has_velocity_ ? kGain : 1.0;
  velocity_ += (gain / elapsed_sec) * (corners_ - asVector(predicted_));
  has_velocity_ = true;
}

void QuadMotion::place(const geometry::Quadrilateral& quad) { corners_ = asVector(quad); }

geometry::Quadrilateral QuadMotion::quad() const { return {corner(0), corner(1), corner(2), corner(3)}; }

double QuadMotion::sigmaAcross(int side) const {
  const Vector2d span = corner(side + 1) - corner(side);
  const Vector2d normal = Vector2d(span.y(), -span.x()) / std::max(1e-9, span.norm());
  double worst = 0.0;
  for (int end : {side, (side + 1) % 4})
    worst = std::max(worst, normal.dot(covariance_.block<2, 2>(2 * end, 2 * end) * normal));
  return std::sqrt(std::max(0.0, worst));
}

}  // namespace window_ingress::detection
