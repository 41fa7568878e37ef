#include "detection/alignment/rectangle_prior.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace window_ingress::detection {
namespace {

using Eigen::Matrix3d;
using geometry::Quadrilateral;

constexpr double kSkewSigma = 0.003;   ///< of the cosine between the sides, from errors of corners and camera
constexpr double kBeyondASide = 0.05;  ///< distance at which the camera counts as beyond a side [sides]

constexpr double kFocal = 0.9;                              ///< without a calibration [longer image sides]
constexpr double kLogFocalSigma = 0.4, kCentreSigma = 0.2;  ///< its logarithm's; the centre's [focal lengths]

constexpr double kX[] = {-0.5, 0.5, 0.5, -0.5}, kY[] = {-0.5, -0.5, 0.5, 0.5};  ///< corners of the opening
constexpr double kLinePx = 0.05;  ///< standard deviation of the known sides when the fourth is placed
constexpr int kCompletingSteps = 4;
constexpr double kVague = 0.03;  ///< a side whose ends are less certain than this is not placed [its lengths]

geometry::PinholeCamera usualCamera(const cv::Size& image) {
  const double focal_px = kFocal * std::max(image.width, image.height);
  return geometry::PinholeCamera::fromFieldOfView(image.width, image.height,
                                                  2.0 * std::atan(0.5 * image.width / focal_px));
}

// Derivatives of a side by the camera: by the focal length's logarithm, by the centre's x and y.
Matrix3d byCamera(const Eigen::Vector3d& side) {
  Matrix3d slopes;
  slopes << -side.x(), -side.z(), 0.0, -side.y(), 0.0, -side.z(), 0.0, 0.0, 0.0;
  return slopes;
}

// Unit normal of a line.
Eigen::Vector2d normalOf(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = (to - from).normalized();
  return {along.y(), -along.x()};
}

void add(double value, const RowVector8d& slope, double variance, double noise, Matrix8f& normal,
         Vector8f& right) {
  normal += (noise / variance * slope.transpose() * slope).cast<float>();
  right -= (noise / variance * value * slope.transpose()).cast<float>();
}

}  // namespace

std::optional<Quadrilateral> cornersOf(const Matrix3d& map) {
  Quadrilateral quad;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = map * Eigen::Vector3d(kX[i], kY[i], 1.0);
    if (!(p.z() > 1e-6)) return std::nullopt;
    quad[i] = p.hnormalized();
  }
  if (!geometry::isFinite(quad) || !geometry::isConvex(quad)) return std::nullopt;
  return quad;
}

RowVector8d slopeAcross(const Matrix3d& map, int corner, const Eigen::Vector2d& direction) {
  const double x = kX[corner], y = kY[corner];
  const Eigen::Vector3d p = map * Eigen::Vector3d(x, y, 1.0);
  const Eigen::Vector2d at = p.hnormalized();
  Eigen::Matrix2d to_image;
  for (int k = 0; k < 2; ++k) to_image.col(k) = (map.block<2, 1>(0, k) - at * map(2, k)) / p.z();
  Eigen::Matrix<double, 2, 8> in_plane;
  in_plane << x, y, 1, 0, 0, 0, -x * x, -x * y, 0, 0, 0, x, y, 1, -x * y, -y * y;
  return direction.transpose() * to_image * in_plane;
}

RectanglePrior::RectanglePrior(const geometry::PinholeCamera& camera, const OpeningAspect& aspect)
    : inverse_camera_(camera.K().inverse()), aspect_(aspect) {}

RectanglePrior::RectanglePrior(const cv::Size& image, const OpeningAspect& aspect)
    : RectanglePrior(usualCamera(image), aspect) {
  camera_sigma_ = {kLogFocalSigma, kCentreSigma, kCentreSigma};
}

// The two contradictions: in aspect and in angle. Slopes are first by p, then by the camera.
std::optional<std::array<RectanglePrior::Contradiction, 2>> RectanglePrior::contradictions(
    const Matrix3d& map) const {
  using Slopes = Eigen::Matrix<double, 1, 11>;
  const Matrix3d view = inverse_camera_ * map;
  const Eigen::Vector3d across = view.col(0), down = view.col(1);
  const double width = across.norm(), height = down.norm(), skew = across.dot(down) / (width * height);
  if (!(width > 0.0 && height > 0.0)) return std::nullopt;
  Eigen::Matrix<double, 3, 11> d_across, d_down;
  d_across << Eigen::Matrix<double, 3, 8>::Zero(), byCamera(across);
  d_down << Eigen::Matrix<double, 3, 8>::Zero(), byCamera(down);
  for (int k = 0; k < 3; ++k) d_across.col(3 * k) = d_down.col(3 * k + 1) = -view.col(k);
  const Slopes log_width = across.transpose() * d_across / (width * width),
               log_height = down.transpose() * d_down / (height * height),
               product = (down.transpose() * d_across + across.transpose() * d_down) / (width * height);
  const auto contradiction = [this](double value, const Slopes& by, double sigma) {
    const double from_camera = by.tail<3>().transpose().cwiseProduct(camera_sigma_).squaredNorm();
    return Contradiction{value, by.head<8>(), sigma * sigma + from_camera};
  };
  return std::array<Contradiction, 2>{
      contradiction(std::log(width / height / aspect_.value), log_width - log_height, aspect_.log_sigma),
      contradiction(skew, product - skew * (log_width + log_height), kSkewSigma)};
}

void RectanglePrior::addTo(const Matrix3d& map, double noise, Matrix8f& normal, Vector8f& right) const {
  if (const auto both = contradictions(map))
    for (const Contradiction& c : *both) add(c.value, c.slope, c.variance, noise, normal, right);
}

double RectanglePrior::misfit(const Matrix3d& map) const {
  const auto both = contradictions(map);
  if (!both) return std::numeric_limits<double>::infinity();
  double squares = 0.0;
  for (const Contradiction& c : *both) squares += c.value * c.value / c.variance;
  return std::sqrt(squares);
}

// The ends of the three other sides stay on their lines.
std::optional<CompletedView> RectanglePrior::completed(const Matrix3d& map, int side) const {
  const auto start = cornersOf(map);
  if (!start) return std::nullopt;
  const Quadrilateral& from = *start;
  CompletedView view{map, 0.0};
  double length_px = 0.0;
  for (int n = 0; n < kCompletingSteps; ++n) {
    const auto corners = cornersOf(view.map);
    if (!corners) return std::nullopt;
    const Quadrilateral& to = *corners;
    Matrix8f normal = 1e-3F * Matrix8f::Identity();
    Vector8f right = Vector8f::Zero();
    for (int i = 0; i < 4; ++i) {
      if (i == side) continue;
      const int next = (i + 1) % 4;
      const Eigen::Vector2d across = normalOf(from[i], from[next]);
      for (int corner : {i, next})
        add(-across.dot(to[corner] - from[i]), slopeAcross(view.map, corner, across), kLinePx * kLinePx, 1.0,
            normal, right);
    }
    addTo(view.map, 1.0, normal, right);
    const auto factors = normal.ldlt();
    const auto change = homographyOf(factors.solve(right));
    if (!change) return std::nullopt;
    const int next = (side + 1) % 4;
    view.sigma_px = 0.0;
    for (int corner : {side, next}) {
      const Vector8f slope = slopeAcross(view.map, corner, normalOf(to[side], to[next])).cast<float>();
      view.sigma_px =
          std::max(view.sigma_px, std::sqrt(static_cast<double>(slope.dot(factors.solve(slope)))));
    }
    view.map = view.map * change->inverse();
    length_px = (to[next] - to[side]).norm();
  }
  if (!(view.sigma_px < kVague * length_px)) return std::nullopt;
  return view;
}

// (x, y): the camera's position relative to the opening's centre [sides]; away: its distance from the plane.
std::array<SideView, 4> RectanglePrior::viewsOfSides(const Matrix3d& map) const {
  const Matrix3d view = inverse_camera_ * map;
  const Eigen::Vector3d across = view.col(0), down = view.col(1), centre = view.col(2);
  const double x = -across.dot(centre) / across.squaredNorm(), y = -down.dot(centre) / down.squaredNorm();
  const double away = std::abs(across.cross(down).normalized().dot(centre));
  const auto from = [away](double beyond, double side) {
    return SideView{std::abs(beyond) * side / std::max(1e-9, away), beyond > kBeyondASide};
  };
  return {from(-y - 0.5, down.norm()), from(x - 0.5, across.norm()), from(y - 0.5, down.norm()),
          from(-x - 0.5, across.norm())};
}

}  // namespace window_ingress::detection
