#include "detection/alignment/rectangle_prior.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

constexpr double kSkewSigma =
    0.003;  ///< of the cosine between the sides: how well corners and camera are known
constexpr double kBeyondASide = 0.05;  ///< of the camera, from a side, to be beyond it [sides]

constexpr double kFocal = 0.9;  ///< of a camera without a calibration [longer image sides]
constexpr double kLogFocalSigma = 0.4,
                 kCentreSigma = 0.2;  ///< of its logarithm; of the centre [focal lengths]

template <int kCount>
using Sides = Eigen::Matrix<double, 3, kCount>;
template <int kCount>
using Slopes = Eigen::Matrix<double, 1, kCount>;

// The two sides of the rectangle in the view, and what they say of its shape.
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

// What a change of the camera moves a side by: of its focal length's logarithm, of its centre in x and in y.
Sides<3> byCamera(const Eigen::Vector3d& side) {
  Sides<3> slopes;
  slopes << -side.x(), -side.z(), 0.0, -side.y(), 0.0, -side.z(), 0.0, 0.0, 0.0;
  return slopes;
}

void add(double value, const Slopes<8>& slope, double variance, double noise, Matrix8f& normal,
         Vector8f& right) {
  normal += (noise / variance * slope.transpose() * slope).cast<float>();
  right -= (noise / variance * value * slope.transpose()).cast<float>();
}

}  // namespace

RectanglePrior::RectanglePrior(const geometry::PinholeCamera& camera, const OpeningAspect& aspect)
    : inverse_camera_(camera.K().inverse()), aspect_(aspect) {}

RectanglePrior::RectanglePrior(const cv::Size& image, const OpeningAspect& aspect)
    : RectanglePrior(usualCamera(image), aspect) {
  camera_sigma_ = {kLogFocalSigma, kCentreSigma, kCentreSigma};
}

void RectanglePrior::addTo(const Eigen::Matrix3d& map, double noise, Matrix8f& normal,
                           Vector8f& right) const {
  const Eigen::Matrix3d view = inverse_camera_ * map;
  const SeenRectangle shape{view.col(0), view.col(1)};
  if (!(shape.width > 0.0 && shape.height > 0.0)) return;
  Sides<8> d_across = Sides<8>::Zero(), d_down = Sides<8>::Zero();  // by p
  for (int k = 0; k < 3; ++k) {
    d_across.col(3 * k) = -view.col(k);
    d_down.col(3 * k + 1) = -view.col(k);
  }
  const Sides<3> across_by_camera = byCamera(shape.across), down_by_camera = byCamera(shape.down);
  const auto variance = [this](double sigma, const Slopes<3>& by_camera) {
    return sigma * sigma + by_camera.transpose().cwiseProduct(camera_sigma_).squaredNorm();
  };
  add(std::log(shape.width / shape.height / aspect_.value), shape.logAspectBy(d_across, d_down),
      variance(aspect_.log_sigma, shape.logAspectBy(across_by_camera, down_by_camera)), noise, normal, right);
  add(shape.skew, shape.skewBy(d_across, d_down),
      variance(kSkewSigma, shape.skewBy(across_by_camera, down_by_camera)), noise, normal, right);
}

// The camera's place before the opening, from its centre: in its sides and from its plane.
std::array<SideView, 4> RectanglePrior::viewsOfSides(const Eigen::Matrix3d& map) const {
  const Eigen::Matrix3d view = inverse_camera_ * map;
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
