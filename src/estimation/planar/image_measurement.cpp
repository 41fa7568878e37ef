#include "estimation/planar/image_measurement.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kMinWhiteSigmaPx = 0.0005;
constexpr double kUnknownSigmaPx = 1.0;  // of a corner without a usable covariance

bool isUsable(double sigma) { return std::isfinite(sigma) && sigma > 0.0; }

bool bordersAreUsable(const detection::WindowObservation& window) {
  return std::all_of(window.edges.begin(), window.edges.end(), [](const detection::Edge& edge) {
    return !edge.visible || (isUsable(edge.sigma_px) && isUsable(edge.sigma_rad));
  });
}

}  // namespace

std::optional<PredictedOpening> predictOpening(const geometry::PinholeCamera& camera,
                                               const Eigen::Isometry3d& T_camera_window,
                                               const geometry::OpeningSize& size) {
  PredictedOpening predicted;
  const auto corners = geometry::openingCorners(size);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d turned = T_camera_window.linear() * corners[i];
    const Eigen::Vector3d p = turned + T_camera_window.translation();
    if (!(p.z() > 1e-3)) return std::nullopt;
    const double x = p.x() / p.z(), y = p.y() / p.z();
    Eigen::Matrix<double, 2, 3> by_point;
    by_point << camera.fx, 0, -camera.fx * x, 0, camera.fy, -camera.fy * y;
    by_point /= p.z();
    predicted.corners_px.segment<2>(2 * i) << camera.fx * x + camera.cx, camera.fy * y + camera.cy;
    predicted.by_pose.block<2, 3>(2 * i, 0) = by_point;
    predicted.by_pose.block<2, 3>(2 * i, 3) = -by_point * skew(turned);
    predicted.by_log_size.block<2, 1>(2 * i, 0) = by_point * T_camera_window.linear().col(1) * corners[i].y();
    predicted.by_log_size.block<2, 1>(2 * i, 1) = by_point * T_camera_window.linear().col(2) * corners[i].z();
  }
  return predicted;
}

Eigen::Isometry3d moved(const Eigen::Isometry3d& T, const Eigen::Matrix<double, 6, 1>& step) {
  const Eigen::Vector3d turn = step.tail<3>();
  const double angle = turn.norm();
  Eigen::Quaterniond rotation(T.linear());
  if (angle > 0.0) rotation = Eigen::AngleAxisd(angle, turn / angle) * rotation;
  return geometry::makePose(rotation.normalized().toRotationMatrix(), T.translation() + step.head<3>());
}

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return matrix;
}

double marginalVariance(double white, double systematic, const ImageNoise& noise) {
  const double marginal =
      (white + noise.looks * systematic) * (white + (noise.looks - 1.0) * systematic) / white;
  return std::max(white + systematic, std::min(marginal, noise.max_looks_variance * systematic));
}

std::optional<ImageMeasurement> ImageMeasurement::make(const detection::WindowObservation& window,
                                                       const geometry::PinholeCamera& camera,
                                                       const ImageNoise& noise) {
  if (!window.whole()) return ofPartial(window, camera, noise);
  ImageMeasurement measurement;
  std::array<Eigen::Matrix2d, 4> slopes;
  for (int i = 0; i < 4; ++i) {
    measurement.corners_px_.segment<2>(2 * i) = camera.undistort(window.corners[i]);
    slopes[i] = camera.distortionSlope(measurement.corners_px_.segment<2>(2 * i)).inverse();
    if (!measurement.corners_px_.segment<2>(2 * i).allFinite() || !slopes[i].allFinite()) return std::nullopt;
  }
  const int visible = window.visibleSides();
  if (visible > 0 && (visible < 4 || bordersAreUsable(window))) {
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d from = measurement.corners_px_.segment<2>(2 * i),
                            to = measurement.corners_px_.segment<2>(2 * ((i + 1) % 4));
      if (window.edges[i].visible && !measurement.addBorder(window.edges[i], i, from, to, camera, noise))
        return std::nullopt;
    }
    return measurement;
  }
  for (int i = 0; i < 4; ++i)
    measurement.addCorner(slopes[i] * window.corner_covariance[i] * slopes[i].transpose(), i, noise);
  return measurement;
}

std::optional<ImageMeasurement> ImageMeasurement::ofPartial(const detection::WindowObservation& window,
                                                            const geometry::PinholeCamera& camera,
                                                            const ImageNoise& noise) {
  ImageMeasurement measurement;
  measurement.has_corners_ = false;
  for (int i = 0; i < 4; ++i) {
    const detection::Edge& edge = window.edges[i];
    if (!edge.visible) continue;
    const Eigen::Vector2d from = camera.undistort(edge.a), to = camera.undistort(edge.b);
    if (!from.allFinite() || !to.allFinite() || !measurement.addBorder(edge, i, from, to, camera, noise))
      return std::nullopt;
  }
  if (measurement.border_count_ == 0) return std::nullopt;
  measurement.has_corners_ = measurement.border_count_ == 4 && measurement.cross();
  return measurement;
}

bool ImageMeasurement::cross() {
  for (int i = 0; i < 4; ++i) {
    const Border &before = borders_[(i + 3) % 4], &after = borders_[i];
    const double sine = before.across.dot(after.along);
    if (std::abs(sine) < 1e-3) return false;
    const double along = before.across.dot(before.middle - after.middle) / sine;
    corners_px_.segment<2>(2 * i) = after.middle + along * after.along;
  }
  return corners_px_.allFinite();
}

bool ImageMeasurement::addBorder(const detection::Edge& edge, int side, const Eigen::Vector2d& from,
                                 const Eigen::Vector2d& to, const geometry::PinholeCamera& camera,
                                 const ImageNoise& noise) {
  const double length = (to - from).norm(), pixel = camera.pixelAcross(0.5 * (from + to), to - from);
  if (!(length > 1e-3) || !std::isfinite(pixel)) return false;
  const double systematic = pixel * noise.systematic_sigma_px;
  const double across = isUsable(edge.sigma_px) ? pixel * edge.sigma_px : kUnknownSigmaPx / std::sqrt(2.0);
  const double turn = isUsable(edge.sigma_rad) ? edge.sigma_rad : kUnknownSigmaPx * std::sqrt(2.0) / length;
  const double white_px = std::max(across, kMinWhiteSigmaPx),
               white_slope = std::max(turn, kMinWhiteSigmaPx / length);
  Border& border = borders_[border_count_++];
  border.side = side;
  border.middle = 0.5 * (from + to);
  border.along = (to - from) / length;
  border.across = {-border.along.y(), border.along.x()};
  border.offset_sigma_px =
      std::sqrt(marginalVariance(white_px * white_px, 0.5 * systematic * systematic, noise));
  const double at_ends = noise.systematic_turn * systematic;
  const double systematic_slope = 2.0 * at_ends * at_ends / (length * length);
  border.slope_sigma = std::sqrt(marginalVariance(white_slope * white_slope, systematic_slope, noise));
  return true;
}

void ImageMeasurement::addCorner(const Eigen::Matrix2d& covariance, int corner, const ImageNoise& noise) {
  Eigen::Matrix2d axes = Eigen::Matrix2d::Identity();
  Eigen::Vector2d white = Eigen::Vector2d::Constant(kUnknownSigmaPx * kUnknownSigmaPx);
  if (covariance.allFinite()) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(0.5 * (covariance + covariance.transpose()));
    if (eigen.eigenvalues().minCoeff() > 0.0) {
      axes = eigen.eigenvectors();
      white = eigen.eigenvalues().cwiseMax(kMinWhiteSigmaPx * kMinWhiteSigmaPx);
    }
  }
  const double systematic = noise.systematic_sigma_px * noise.systematic_sigma_px;
  for (int axis = 0; axis < 2; ++axis)
    corner_weights_[corner].row(axis) =
        axes.col(axis).transpose() / std::sqrt(marginalVariance(white(axis), systematic, noise));
}

LinearisedResidual ImageMeasurement::evaluate(const CornerVector& predicted_px) const {
  LinearisedResidual out{Residual::Zero(size()), ResidualJacobian<8>::Zero(size(), 8)};
  for (int i = 0; i < border_count_; ++i) evaluateBorder(borders_[i], predicted_px, 2 * i, out);
  for (int i = 0; i < 4 && border_count_ == 0; ++i) {
    out.residual.segment<2>(2 * i) =
        corner_weights_[i] * (predicted_px.segment<2>(2 * i) - corners_px_.segment<2>(2 * i));
    out.by_corners.block<2, 2>(2 * i, 2 * i) = corner_weights_[i];
  }
  return out;
}

void ImageMeasurement::evaluateBorder(const Border& border, const CornerVector& predicted_px, int row,
                                      LinearisedResidual& out) const {
  const int a = 2 * border.side, b = 2 * ((border.side + 1) % 4);
  const Eigen::Vector2d from = predicted_px.segment<2>(a) - border.middle;
  const Eigen::Vector2d to = predicted_px.segment<2>(b) - border.middle;
  const double from_along = from.dot(border.along), span = to.dot(border.along) - from_along;
  const double length = std::copysign(std::max(std::abs(span), 1e-3), span);
  const double slope = (to - from).dot(border.across) / length;

  const Eigen::RowVector2d slope_by_to = (border.across - slope * border.along).transpose() / length;
  const Eigen::RowVector2d offset_by_from =
      (border.across - slope * border.along).transpose() + from_along * slope_by_to;
  out.residual(row) = (from.dot(border.across) - from_along * slope) / border.offset_sigma_px;
  out.residual(row + 1) = slope / border.slope_sigma;
  out.by_corners.block<1, 2>(row, a) = offset_by_from / border.offset_sigma_px;
  out.by_corners.block<1, 2>(row, b) = -from_along * slope_by_to / border.offset_sigma_px;
  out.by_corners.block<1, 2>(row + 1, a) = -slope_by_to / border.slope_sigma;
  out.by_corners.block<1, 2>(row + 1, b) = slope_by_to / border.slope_sigma;
}

}  // namespace window_ingress::estimation
