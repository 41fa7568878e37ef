#include "detection/reference/reference_shape.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "window_ingress/geometry/unit_square.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3f;
using geometry::PinholeCamera;
using geometry::Quadrilateral;

constexpr double kMaxSigmas = 3.0;      ///< tolerance of a shape against the reference's
constexpr double kMaxFactor = 2.0;      ///< tolerance of the aspect where the camera is unknown
constexpr double kFrameSlack = 0.15;    ///< additional tolerance of the width of a frame
constexpr double kSlopePx = 1e-3;       ///< step of numeric slopes [px]
constexpr double kCornerSigmaPx = 0.3;  ///< least standard deviation of a corner, each way [px]
constexpr double kAspectSigma = 0.01;   ///< of the logarithm of the reference's aspect, at best
constexpr double kFrameSigmaPx = 0.03;  ///< standard deviation of the width of a frame [px]

constexpr double kShapeInward = 0.02, kShapeOutward = 0.36;  ///< of the profiles [mean sides of the opening]
constexpr double kThinnest = 0.015, kWidest = 0.14;          ///< frame [mean sides of the opening]
constexpr double kBlur_px = 3.0;                          ///< nearer to a border, the border's own edge shows
constexpr double kSurroundFrom = 2.1, kSurroundTo = 2.6;  ///< band of the wall [widths of the frame]
constexpr double kCoreFrom = 0.2, kCoreTo = 0.9;  ///< band of the frame's own colour [widths of the frame]
constexpr float kMinFrameContrast = 20.0F;        ///< of frame and wall [grey levels]
constexpr int kFewestSides = 3;
constexpr double kScatter = 0.1;                               ///< part of the middle two widths' difference
constexpr double kFocalLengths[] = {0.5, 0.7, 1.0, 1.4, 2.0};  ///< in longer sides of the image

// The homography from the opening to lines of sight.
Eigen::Matrix3d sightOf(const Quadrilateral& ideal, const PinholeCamera& camera) {
  Quadrilateral rays = ideal;
  for (Vector2d& p : rays) p = {(p.x() - camera.cx) / camera.fx, (p.y() - camera.cy) / camera.fy};
  return geometry::UnitSquare(rays).matrix();
}

// Aspects for all likely focal lengths; NaN if this is no rectangle's image.
std::array<double, std::size(kFocalLengths)> likelyAspects(const Quadrilateral& quad, const cv::Size& image) {
  std::array<double, std::size(kFocalLengths)> aspects{};
  PinholeCamera camera;
  camera.cx = 0.5 * (image.width - 1), camera.cy = 0.5 * (image.height - 1);
  for (std::size_t i = 0; i < aspects.size(); ++i) {
    camera.fx = camera.fy = kFocalLengths[i] * std::max(image.width, image.height);
    const Eigen::Matrix3d map = sightOf(quad, camera);
    aspects[i] = map.col(0).norm() / map.col(1).norm();
  }
  return aspects;
}

// Two quantities that are 0 for any view of a rectangle of this aspect: the logarithm of the seen aspect over
// this one, and the cosine between the sides.
Vector2d offRectangle(const Quadrilateral& ideal, const PinholeCamera& camera, double aspect) {
  const Eigen::Matrix3d map = sightOf(ideal, camera);
  const double width = map.col(0).norm(), height = map.col(1).norm();
  return {std::log(width / height / aspect), map.col(0).dot(map.col(1)) / (width * height)};
}

// Width of the frame beside the border at 0, edge to edge at any blur: mixed colours count by their share of
// frame. 0 where frame and wall cannot be told apart.
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

}  // namespace

// Chi of the two quantities, with their covariance by the slopes. For small misfits it equals what a fit of
// pose and aspect leaves.
std::optional<double> rectangleMisfit(const Quadrilateral& ideal, const std::array<Matrix2d, 4>& covariance,
                                      const PinholeCamera& camera, const OpeningAspect& aspect) {
  if (!geometry::isFinite(ideal) || !geometry::isConvex(ideal)) return std::nullopt;
  const Vector2d off = offRectangle(ideal, camera, aspect.value);
  Matrix2d spread = Vector2d(aspect.log_sigma * aspect.log_sigma, 0.0).asDiagonal();
  for (int i = 0; i < 4; ++i) {
    Matrix2d slopes;
    for (int k = 0; k < 2; ++k) {
      Quadrilateral less = ideal, more = ideal;
      less[i][k] -= kSlopePx, more[i][k] += kSlopePx;
      slopes.col(k) = (offRectangle(more, camera, aspect.value) - offRectangle(less, camera, aspect.value)) /
                      (2.0 * kSlopePx);
    }
    spread += slopes * (covariance[i] + kCornerSigmaPx * kCornerSigmaPx * Matrix2d::Identity()) *
              slopes.transpose();
  }
  const double square = off.dot(spread.inverse() * off);
  if (!(square >= 0.0 && std::isfinite(square))) return std::nullopt;
  return std::sqrt(square);
}

void ReferenceShape::learn(const cv::Mat& image, const Quadrilateral& opening) {
  *this = {};
  if (image.empty() || !geometry::isFinite(opening) || !geometry::isConvex(opening)) return;
  const auto aspects = likelyAspects(opening, image.size());
  const auto [least_at, most_at] = std::minmax_element(aspects.begin(), aspects.end());
  const double least = *least_at, most = *most_at;
  if (!(most > 0.0 && most < 1e9)) return;
  const double middle = std::sqrt(least * most);
  aspect_ = OpeningAspect{middle, std::max(kAspectSigma, 0.5 * (most - least) / middle)};
  seen_aspect_ = geometry::aspectRatio(opening);
  if (image.type() != CV_8UC3) return;
  measureSides(image, opening, nullptr, {kShapeInward, kShapeOutward, seen_aspect_}, sides_);
  const double thinnest = std::max(kThinnest, kBlur_px / geometry::meanSide(opening));
  for (int i = 0; i < 4; ++i) {
    double end = 0.0;
    if (sides_[i].largestChange(thinnest, kWidest, &end) >= kMinFrameContrast)
      frame_[i] = paintedWidth(sides_[i], end);
  }
}

std::optional<Rejection> ReferenceShape::inAspect(const Quadrilateral& corners,
                                                  const std::array<Eigen::Matrix2d, 4>& covariance,
                                                  const cv::Size& image, const PinholeCamera* camera) const {
  if (!aspect_) return std::nullopt;
  if (!camera) {
    double off = 1e9;
    for (double aspect : likelyAspects(corners, image))
      off = std::min(off, std::max(aspect / aspect_->value, aspect_->value / aspect));
    if (off <= kMaxFactor) return std::nullopt;
    return Rejection{RejectReason::kOtherAspect, off, kMaxFactor};
  }
  const auto seen = rectangleMisfit(geometry::undistorted(corners, geometry::lensOf(camera)), covariance,
                                    *camera, *aspect_);
  if (!seen || *seen <= kMaxSigmas) return std::nullopt;
  return Rejection{RejectReason::kOtherAspect, *seen, kMaxSigmas};
}

// The difference of the two middle ratios adds to the spread of their mean.
std::optional<Rejection> ReferenceShape::inFrame(const cv::Mat& image, const Quadrilateral& corners,
                                                 const PinholeCamera* camera) {
  if (image.type() != CV_8UC3 || !geometry::isFinite(corners) || !geometry::isConvex(corners))
    return std::nullopt;
  measureSides(image, corners, camera, {kShapeInward, kShapeOutward, seen_aspect_}, sides_);
  std::vector<double> ratios;
  double widths = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double width = frame_[i] > 0.0 ? paintedWidth(sides_[i], frame_[i]) : 0.0;
    if (width > 0.0) ratios.push_back(width / frame_[i]), widths += frame_[i];
  }
  if (static_cast<int>(ratios.size()) < kFewestSides) return std::nullopt;
  std::sort(ratios.begin(), ratios.end());
  const double low = ratios[(ratios.size() - 1) / 2], high = ratios[ratios.size() / 2],
               seen = 0.5 * (low + high);
  const double side_px = geometry::meanSide(geometry::undistorted(corners, geometry::lensOf(camera)));
  const double least_sigma = kFrameSigmaPx * static_cast<double>(ratios.size()) / (widths * side_px);
  const double spread = kFrameSlack + kMaxSigmas * std::hypot(least_sigma, kScatter * (high - low));
  if (std::abs(seen - 1.0) <= spread) return std::nullopt;
  return Rejection{RejectReason::kOtherFrame, seen, seen > 1.0 ? 1.0 + spread : 1.0 - spread};
}

}  // namespace window_ingress::detection
