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
  Vector8d v;
  for (int i = 0; i < 4; ++i) v.segment<2>(2 * i) = quad[i];
  return v;
}

geometry::Quadrilateral asQuad(const Vector8d& v) {
  geometry::Quadrilateral quad;
  for (int i = 0; i < 4; ++i) quad[i] = v.segment<2>(2 * i);
  return quad;
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

QuadMotion::Row QuadMotion::offsetRow(int side, const Line& line) const {
  const Vector2d from = corner(side), span = corner(side + 1) - from;
  const double t = (line.point - from).dot(span) / std::max(1.0, span.squaredNorm());
  Row row;
  row.weights.segment<2>(2 * side) = (1.0 - t) * line.normal;
  row.weights.segment<2>(2 * ((side + 1) % 4)) = t * line.normal;
  row.rest = -line.distance(from + t * span);
  row.variance = std::pow(std::max(kMinSigmaPx, line.sigma_px), 2);
  return row;
}

QuadMotion::Row QuadMotion::slopeRow(int side, const Line& line) const {
  const Vector2d span = corner(side + 1) - corner(side);
  const double length = std::max(1.0, span.norm());
  Row row;
  row.weights.segment<2>(2 * side) = -line.normal / length;
  row.weights.segment<2>(2 * ((side + 1) % 4)) = line.normal / length;
  row.rest = -line.normal.dot(span) / length;
  row.variance = std::pow(std::max(kMinSigmaPx / length, line.sigma_rad), 2);
  return row;
}

void QuadMotion::correct(const Row& row) {
  const Vector8d spread = covariance_ * row.weights;
  const double variance = row.weights.dot(spread) + row.variance;
  corners_ += spread * (row.rest / variance);
  covariance_ -= spread * spread.transpose() / variance;
}

void QuadMotion::correct(int side, const Line& line) {
  correct(offsetRow(side, line));
  correct(slopeRow(side, line));
}

void QuadMotion::settle(double elapsed_sec) {
  if (!(elapsed_sec > 1e-4)) return;
  const double gain = has_velocity_ ? kGain : 1.0;
  velocity_ += (gain / elapsed_sec) * (corners_ - asVector(predicted_));
  has_velocity_ = true;
}

void QuadMotion::place(const geometry::Quadrilateral& quad) { corners_ = asVector(quad); }

geometry::Quadrilateral QuadMotion::quad() const { return asQuad(corners_); }

double QuadMotion::sigmaAcross(int side) const {
  const Vector2d span = corner(side + 1) - corner(side);
  const Vector2d normal = Vector2d(span.y(), -span.x()) / std::max(1e-9, span.norm());
  double worst = 0.0;
  for (int end : {side, (side + 1) % 4})
    worst = std::max(worst, normal.dot(covariance_.block<2, 2>(2 * end, 2 * end) * normal));
  return std::sqrt(std::max(0.0, worst));
}

}  // namespace window_ingress::detection
