#include "detection/reference/reference_shape.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "detection/quads.hpp"
#include "window_ingress/geometry/unit_square.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;
using geometry::PinholeCamera;
using geometry::Quadrilateral;

constexpr double kMaxSigmas = 3.0;      ///< by which a shape may differ from the reference's
constexpr double kFrameSlack = 0.15;    ///< and the width of a frame by this part besides
constexpr double kCornerSigmaPx = 0.3;  ///< least standard deviation of a corner, each way [px]
constexpr double kAspectSigma =
    0.03;  ///< of the logarithm of the aspect: how well the reference shows it, at best
constexpr double kLeastAspectSigma = 0.01;  ///< the same, for a prior: its corners are good to a pixel or so
constexpr double kFrameSigmaPx = 0.03;      ///< standard deviation of the width of a frame [px]

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

constexpr double kShapeInward = 0.02, kShapeOutward = 0.36;  ///< of the profiles [mean sides of the opening]
constexpr double kThinnest = 0.015, kWidest = 0.14;          ///< frame [mean sides of the opening]
constexpr double kBlur_px = 3.0;                             ///< nearer to the border its own edge shows
constexpr double kSurroundFrom = 2.1, kSurroundTo = 2.6;     ///< where the wall is, in widths of the frame
constexpr double kCoreFrom = 0.2, kCoreTo = 0.9;             ///< and the frame's own colour
constexpr float kMinFrameContrast = 20.0F;                   ///< of frame and wall [grey levels]
constexpr std::size_t kFewestSides = 3;
constexpr double kScatter = 0.1;                               ///< of the difference of the middle two widths
constexpr double kFocalLengths[] = {0.5, 0.7, 1.0, 1.4, 2.0};  ///< in longer sides of the image

// NaN for what is no rectangle's image.
double aspectOf(const Quadrilateral& ideal, const PinholeCamera& camera) {
  Quadrilateral rays = ideal;
  for (Vector2d& p : rays) p = {(p.x() - camera.cx) / camera.fx, (p.y() - camera.cy) / camera.fy};
  const Eigen::Matrix3d map = geometry::UnitSquare(rays).matrix();
  return map.col(0).norm() / map.col(1).norm();
}

// Width of the frame beside the border at 0, edge to edge whatever the blur: colours between frame and wall
// count by their part of frame. 0 where frame and wall cannot be told apart.
double paintedWidth(const SideProfile& side, double expected) {
  Vector3f wall;
  if (!side.mean(kSurroundFrom * expected, kSurroundTo * expected, wall)) return 0.0;
  float contrast = 0.0F;
  int core = -1;
  const int count = static_cast<int>(side.means.size());
  for (int k = 0; k < count && side.at(k) <= kCoreTo * expected; ++k)
    if (side.at(k) >= kCoreFrom * expected && (side.means[k] - wall).norm() > contrast)
      contrast = (side.means[k] - wall).norm(), core = k;
  if (contrast < kMinFrameContrast) return 0.0;
  const Vector3f direction = (side.means[core] - wall) / (contrast * contrast);
  double width = side.at(core) - 0.5 * side.step;
  for (int k = core; k < count && side.at(k) < kSurroundFrom * expected; ++k)
    width += side.step * std::clamp(direction.dot(side.means[k] - wall), 0.0F, 1.0F);
  return width;
}

// Mean of the two middle ones, whose difference is part of its spread.
Measured middleOf(std::vector<double>& values, double least_sigma) {
  std::sort(values.begin(), values.end());
  const double low = values[(values.size() - 1) / 2], high = values[values.size() / 2];
  return {0.5 * (low + high), std::hypot(least_sigma, kScatter * (high - low))};
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

void ReferenceShape::learn(const cv::Mat& picture, const Quadrilateral& opening) {
  forget();
  if (picture.empty() || !geometry::isFinite(opening) || !geometry::isConvex(opening)) return;
  double least = 1e9, most = 0.0;
  for (double focal : kFocalLengths) {
    PinholeCamera camera;
    camera.fx = camera.fy = focal * std::max(picture.cols, picture.rows);
    camera.cx = 0.5 * (picture.cols - 1), camera.cy = 0.5 * (picture.rows - 1);
    const double aspect = aspectOf(opening, camera);
    least = std::min(least, aspect), most = std::max(most, aspect);
  }
  if (!(most > 0.0 && most < 1e9)) return;
  aspect_ = Measured{std::sqrt(least * most), 0.5 * (most - least)};
  seen_aspect_ = geometry::aspectRatio(opening);
  if (picture.type() != CV_8UC3) return;
  measureSides(picture, opening, nullptr, {kShapeInward, kShapeOutward, seen_aspect_}, sides_);
  const double thinnest = std::max(kThinnest, kBlur_px / meanSide(opening));
  for (int i = 0; i < 4; ++i) {
    double end = 0.0;
    if (sides_[i].largestChange(thinnest, kWidest, &end) < kMinFrameContrast) continue;
    frame_[i] = paintedWidth(sides_[i], end);
  }
}

std::optional<OpeningAspect> ReferenceShape::aspect() const {
  if (!aspect_) return std::nullopt;
  return OpeningAspect{aspect_->value, std::max(kLeastAspectSigma, aspect_->sigma / aspect_->value)};
}

std::optional<ReferenceShape::Difference> ReferenceShape::inAspect(
    const Quadrilateral& corners, const std::array<Eigen::Matrix2d, 4>& covariance,
    const PinholeCamera* camera) const {
  if (!aspect_ || !camera) return std::nullopt;
  RectangleMisfit misfit;
  misfit.aspect = aspect()->value;
  misfit.log_aspect_sigma = std::max(kAspectSigma, aspect()->log_sigma);
  misfit.least_px = kCornerSigmaPx;
  const auto seen =
      misfit.of(undistorted(corners, camera->hasDistortion() ? camera : nullptr), covariance, *camera);
  if (!seen || *seen <= kMaxSigmas) return std::nullopt;
  return Difference{*seen, kMaxSigmas};
}

std::optional<Measured> ReferenceShape::frameRatio(const cv::Mat& image, const Quadrilateral& corners,
                                                   const PinholeCamera* camera) {
  if (image.type() != CV_8UC3 || !geometry::isFinite(corners) || !geometry::isConvex(corners))
    return std::nullopt;
  if (*std::max_element(frame_.begin(), frame_.end()) <= 0.0) return std::nullopt;
  const PinholeCamera* lens = camera && camera->hasDistortion() ? camera : nullptr;
  const Quadrilateral ideal = undistorted(corners, lens);
  measureSides(image, ideal, lens, {kShapeInward, kShapeOutward, seen_aspect_}, sides_);
  ratios_.clear();
  double widths = 0.0;
  for (int i = 0; i < 4; ++i) {
    if (frame_[i] <= 0.0) continue;
    const double width = paintedWidth(sides_[i], frame_[i]);
    if (width > 0.0) ratios_.push_back(width / frame_[i]), widths += frame_[i];
  }
  if (ratios_.size() < kFewestSides) return std::nullopt;
  return middleOf(ratios_, kFrameSigmaPx * static_cast<double>(ratios_.size()) / (widths * meanSide(ideal)));
}

std::optional<ReferenceShape::Difference> ReferenceShape::inFrame(const cv::Mat& image,
                                                                  const Quadrilateral& corners,
                                                                  const PinholeCamera* camera) {
  const auto seen = frameRatio(image, corners, camera);
  if (!seen) return std::nullopt;
  const double spread = kFrameSlack + kMaxSigmas * seen->sigma;
  if (std::abs(seen->value - 1.0) <= spread) return std::nullopt;
  return Difference{seen->value, seen->value > 1.0 ? 1.0 + spread : 1.0 - spread};
}

}  // namespace window_ingress::detection
