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

using RowVector8d = Eigen::Matrix<double, 1, 8>;

void add(double value, const RowVector8d& slope, double weight, Matrix8f& normal, Vector8f& right) {
  normal += (weight * slope.transpose() * slope).cast<float>();
  right -= (weight * value * slope.transpose()).cast<float>();
}

}  // namespace

RectanglePrior::RectanglePrior(const geometry::PinholeCamera& camera, const OpeningAspect& aspect)
    : inverse_camera_(camera.K().inverse()), aspect_(aspect) {}

void RectanglePrior::addTo(const Eigen::Matrix3d& map, double noise, Matrix8f& normal,
                           Vector8f& right) const {
  const Eigen::Matrix3d view = inverse_camera_ * map;
  const Eigen::Vector3d across = view.col(0), down = view.col(1);
  const double width = across.norm(), height = down.norm();
  if (!(width > 0.0 && height > 0.0)) return;
  Eigen::Matrix<double, 3, 8> d_across, d_down;  // by p
  d_across.setZero(), d_down.setZero();
  for (int k = 0; k < 3; ++k) {
    d_across.col(3 * k) = -view.col(k);
    d_down.col(3 * k + 1) = -view.col(k);
  }
  const RowVector8d d_log_width = across.transpose() * d_across / (width * width);
  const RowVector8d d_log_height = down.transpose() * d_down / (height * height);
  const double log_aspect = std::log(width / height / aspect_.value);
  add(log_aspect, d_log_width - d_log_height, noise / (aspect_.log_sigma * aspect_.log_sigma), normal, right);
  const double skew = across.dot(down) / (width * height);
  const RowVector8d d_skew = (down.transpose() * d_across + across.transpose() * d_down) / (width * height) -
                             skew * (d_log_width + d_log_height);
  add(skew, d_skew, noise / (kSkewSigma * kSkewSigma), normal, right);
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
