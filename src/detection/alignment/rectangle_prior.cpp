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

constexpr double kFocal = 0.9;  ///< without a calibration [longer image sides]
constexpr double kLogFocalSigma = 0.4,
                 kCentreSigma = 0.2;  ///< of the logarithm; of the centre [focal lengths]

constexpr double kX[] = {-0.5, 0.5, 0.5, -0.5}, kY[] = {-0.5, -0.5, 0.5, 0.5};  ///< corners of the opening
constexpr double kLinePx = 0.05;  ///< standard deviation of the known sides when the fourth is placed
constexpr int kCompletingSteps = 4;
constexpr double kVague = 0.03;  ///< a side whose ends are less certain than this is not placed [its lengths]

template <int kCount>
using Sides = Eigen::Matrix<double, 3, kCount>;
template <int kCount>
using Slopes = Eigen::Matrix<double, 1, kCount>;

// The two side directions of the rectangle as seen, and what they say about its shape.
struct SeenRectangle {
  Eigen::Vector3d across, down;
  double width = across.norm(), height = down.norm();
  double skew = across.dot(down) / (width * height);

  template <int kCount>
  Slopes<kCount> logAspectBy(const Sides<kCount>& d_across, const Sides<kCount>& d_down) const {
    return across.transpose() * d_across / (width * width) - down.transpose() * d_down / (height * height);
  }

  template <int kCount>
  Slopes<kCount> skewBy(const Sides<kCount>& d_across, const Sides<kCount>& d_down) const {
    return (down.transpose() * d_across + across.transpose() * d_down) / (width * height) -
           skew * (across.transpose() * d_across / (width * width) +
                   down.transpose() * d_down / (height * height));
  }
};

geometry::PinholeCamera usualCamera(const cv::Size& image) {
  const double focal_px = kFocal * std::max(image.width, image.height);
  return geometry::PinholeCamera::fromFieldOfView(image.width, image.height,
                                                  2.0 * std::atan(0.5 * image.width / focal_px));
}

// Derivatives of a side by the camera: by the focal length's logarithm, by the centre's x and y.
Sides<3> byCamera(const Eigen::Vector3d& side) {
  Sides<3> slopes;
  slopes << -side.x(), -side.z(), 0.0, -side.y(), 0.0, -side.z(), 0.0, 0.0, 0.0;
  return slopes;
}

// Unit normal of a line.
Eigen::Vector2d normalOf(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = (to - from).normalized();
  return {along.y(), -along.x()};
}

void add(double value, const Slopes<8>& slope, double variance, double noise, Matrix8f& normal,
         Vector8f& right) {
  normal += (noise / variance * slope.transpose() * slope).cast<float>();
  right -= (noise / variance * value * slope.transpose()).cast<float>();
}

}  // namespace

bool cornersOf(const Matrix3d& map, Quadrilateral& quad) {
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = map * Eigen::Vector3d(kX[i], kY[i], 1.0);
    if (!(p.z() > 1e-6)) return false;
    quad[i] = p.hnormalized();
  }
  return geometry::isFinite(quad) && geometry::isConvex(quad);
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

// The two contradictions: in aspect and in angle.
std::optional<std::array<RectanglePrior::Contradiction, 2>> RectanglePrior::contradictions(
    const Matrix3d& map) const {
  const Matrix3d view = inverse_camera_ * map;
  const SeenRectangle shape{view.col(0), view.col(1)};
  if (!(shape.width > 0.0 && shape.height > 0.0)) return std::nullopt;
  Sides<8> d_across = Sides<8>::Zero(), d_down = Sides<8>::Zero();  // by p
  for (int k = 0; k < 3; ++k) {
    d_across.col(3 * k) = -view.col(k);
    d_down.col(3 * k + 1) = -view.col(k);
  }
  const Sides<3> across_by_camera = byCamera(shape.across), down_by_camera = byCamera(shape.down);
  const auto variance = [this](double sigma, const Slopes<3>& by_camera) {
    return sigma * sigma + by_camera.transpose().cwiseProduct(camera_sigma_).squaredNorm();
  };
  const Contradiction in_aspect{
      std::log(shape.width / shape.height / aspect_.value), shape.logAspectBy(d_across, d_down),
      variance(aspect_.log_sigma, shape.logAspectBy(across_by_camera, down_by_camera))};
  const Contradiction in_angle{shape.skew, shape.skewBy(d_across, d_down),
                               variance(kSkewSigma, shape.skewBy(across_by_camera, down_by_camera))};
  return std::array<Contradiction, 2>{in_aspect, in_angle};
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
  Quadrilateral from, to;
  if (!cornersOf(map, from)) return std::nullopt;
  CompletedView view{map, 0.0};
  for (int n = 0; n < kCompletingSteps; ++n) {
    if (!cornersOf(view.map, to)) return std::nullopt;
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
  }
  if (!(view.sigma_px < kVague * (to[(side + 1) % 4] - to[side]).norm())) return std::nullopt;
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
