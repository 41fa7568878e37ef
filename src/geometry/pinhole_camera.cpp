#include "window_ingress/geometry/pinhole_camera.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/image_border.hpp"

namespace window_ingress::geometry {
namespace {

constexpr double kMinFocal_px = 1.0, kMax_px = 1e6;

struct Distorted {
  Eigen::Vector2d point;
  Eigen::Matrix2d jacobian;
};

// OpenCV's plumb_bob model on normalised coordinates, with its derivative.
Distorted distortNormalised(const std::array<double, 5>& d, const Eigen::Vector2d& p) {
  const auto [k1, k2, p1, p2, k3] = d;
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));  // d radial / d r2, times two
  Distorted out;
  out.point << x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
      y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y;
  const double mixed = slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y;
  out.jacobian << radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x, mixed, mixed,
      radial + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x;
  return out;
}

Eigen::Vector2d undistortNormalised(const std::array<double, 5>& d, const Eigen::Vector2d& target) {
  Eigen::Vector2d p = target;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Distorted distorted = distortNormalised(d, p);
    const Eigen::Vector2d step = distorted.jacobian.inverse() * (target - distorted.point);
    if (!step.allFinite()) break;
    p += step;
    if (step.squaredNorm() < 1e-22) break;
  }
  return p;
}

constexpr double kWidestRad = 1.5;  // of an equidistant lens: there are no ideal pixels further off the axis

double bent(const std::array<double, 5>& d, double theta) {
  const double t2 = theta * theta;
  return theta * (1.0 + t2 * (d[0] + t2 * (d[1] + t2 * (d[2] + t2 * d[3]))));
}

double slopeOfBent(const std::array<double, 5>& d, double theta) {
  const double t2 = theta * theta;
  return 1.0 + t2 * (3.0 * d[0] + t2 * (5.0 * d[1] + t2 * (7.0 * d[2] + t2 * 9.0 * d[3])));
}

double straightened(const std::array<double, 5>& d, double bent_rad) {
  double theta = std::min(bent_rad, kWidestRad);
  for (int iteration = 0; iteration < 20; ++iteration) {
    const double step = (bent_rad - bent(d, theta)) / slopeOfBent(d, theta);
    if (!std::isfinite(step)) break;
    theta = std::clamp(theta + step, 0.0, kWidestRad);
    if (std::abs(step) < 1e-12) break;
  }
  return theta;
}

// On normalised coordinates; keeps the direction about the axis.
Eigen::Vector2d distortEquidistant(const std::array<double, 5>& d, const Eigen::Vector2d& p) {
  const double radius = p.norm();
  return radius > 1e-12 ? Eigen::Vector2d(p * (bent(d, std::atan(radius)) / radius)) : p;
}

Eigen::Vector2d undistortEquidistant(const std::array<double, 5>& d, const Eigen::Vector2d& p) {
  const double radius = p.norm();
  return radius > 1e-12 ? Eigen::Vector2d(p * (std::tan(straightened(d, radius)) / radius)) : p;
}

template <typename Iterator>
bool areZero(Iterator begin, Iterator end) {
  return std::all_of(begin, end, [](double number) { return number == 0.0; });
}

}  // namespace

PinholeCamera PinholeCamera::fromFieldOfView(int width_px, int height_px, double horizontal_fov_rad) {
  PinholeCamera camera;
  camera.width = width_px;
  camera.height = height_px;
  camera.fx = camera.fy = 0.5 * width_px / std::tan(0.5 * horizontal_fov_rad);
  camera.cx = 0.5 * (width_px - 1);
  camera.cy = 0.5 * (height_px - 1);
  return camera;
}

std::vector<std::string> PinholeCamera::validate() const {
  std::vector<std::string> faults;
  if (width <= 0 || height <= 0 || width > 20000 || height > 20000)
    faults.push_back("image size " + std::to_string(width) + "x" + std::to_string(height) +
                     " is not within 1..20000 pixels");
  const std::array<double, 4> intrinsics{fx, fy, cx, cy};
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(intrinsics.begin(), intrinsics.end(), finite))
    faults.push_back("K holds a number that is not finite");
  else if (fx == 0.0 && fy == 0.0)
    faults.push_back("uncalibrated: K is zero; calibrate the camera or load its camera_info");
  else if (fx <= 0.0 || fy <= 0.0)
    faults.push_back("focal length must be positive");
  else if (std::min(fx, fy) < kMinFocal_px || std::max({fx, fy, std::abs(cx), std::abs(cy)}) > kMax_px)
    faults.push_back(
        "K is that of no camera: focal lengths are within 1 to 1e6 px, the principal point within 1e6 px");
  if (!std::all_of(distortion.begin(), distortion.end(), finite))
    faults.push_back("D holds a number that is not finite");
  return faults;
}

bool PinholeCamera::hasDistortion() const {
  return model == LensModel::kEquidistant || !areZero(distortion.begin(), distortion.end());
}

PinholeCamera PinholeCamera::withoutDistortion() const {
  PinholeCamera ideal = *this;
  ideal.distortion = {};
  ideal.model = LensModel::kPlumbBob;
  return ideal;
}

Eigen::Matrix3d PinholeCamera::K() const {
  Eigen::Matrix3d k;
  k << fx, 0, cx, 0, fy, cy, 0, 0, 1;
  return k;
}

std::optional<Eigen::Vector2d> PinholeCamera::project(const Eigen::Vector3d& p_camera) const {
  if (!(p_camera.z() > 1e-9)) return std::nullopt;
  return distort({fx * p_camera.x() / p_camera.z() + cx, fy * p_camera.y() / p_camera.z() + cy});
}

Eigen::Vector2d PinholeCamera::distort(const Eigen::Vector2d& ideal_px) const {
  if (!hasDistortion()) return ideal_px;
  const Eigen::Vector2d ideal = normalised(ideal_px);
  const Eigen::Vector2d p = model == LensModel::kEquidistant ? distortEquidistant(distortion, ideal)
                                                             : distortNormalised(distortion, ideal).point;
  return {fx * p.x() + cx, fy * p.y() + cy};
}

Eigen::Matrix2d PinholeCamera::distortionSlope(const Eigen::Vector2d& ideal_px) const {
  if (!hasDistortion()) return Eigen::Matrix2d::Identity();
  Eigen::Matrix2d slope;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d h = 0.5 * Eigen::Vector2d::Unit(axis);
    slope.col(axis) = distort(ideal_px + h) - distort(ideal_px - h);
  }
  return slope;
}

double PinholeCamera::pixelAcross(const Eigen::Vector2d& ideal_px, const Eigen::Vector2d& along) const {
  if (!hasDistortion()) return 1.0;
  const Eigen::Matrix2d slope = distortionSlope(ideal_px);
  return (slope * along).norm() / (along.norm() * std::abs(slope.determinant()));
}

Eigen::Vector2d PinholeCamera::undistort(const Eigen::Vector2d& distorted_px) const {
  if (!hasDistortion()) return distorted_px;
  const Eigen::Vector2d seen = normalised(distorted_px);
  const Eigen::Vector2d p = model == LensModel::kEquidistant ? undistortEquidistant(distortion, seen)
                                                             : undistortNormalised(distortion, seen);
  return {fx * p.x() + cx, fy * p.y() + cy};
}

Eigen::Vector3d PinholeCamera::ray(const Eigen::Vector2d& distorted_px) const {
  const Eigen::Vector3d ray = normalised(undistort(distorted_px)).homogeneous();
  return ray.stableNormalized();
}

bool PinholeCamera::contains(const Eigen::Vector2d& pixel, double margin_px) const {
  return isInside(pixel, width, height, margin_px);
}

std::string setLens(const std::string& model, const std::vector<double>& coefficients,
                    PinholeCamera& camera) {
  const bool is_fisheye = model == "equidistant" || model == "fisheye";
  const bool is_plumb_bob = model == "plumb_bob", is_rational = model == "rational_polynomial";
  const std::size_t count = coefficients.size();
  const bool is_straight = areZero(coefficients.begin(), coefficients.end());
  if (model.empty() && is_straight) return "";
  if (!is_fisheye && !is_plumb_bob && !is_rational)
    return "distortion model '" + model.substr(0, 40) +
           "' is not supported, only plumb_bob, equidistant (fisheye) and rational_polynomial; for others "
           "use rectified images (image_proc) and set vehicle/image_is_rectified";
  if (!is_fisheye && is_straight) return "";
  const std::size_t wanted = is_plumb_bob ? 5 : is_rational ? 8 : 4;
  if (count != wanted && !(is_plumb_bob && count == 4))
    return "D holds " + std::to_string(count) + " numbers, " + model + " has " + std::to_string(wanted);
  if (is_rational && !areZero(coefficients.begin() + 5, coefficients.end()))
    return "distortion model rational_polynomial is supported with k4 = k5 = k6 = 0 only; calibrate with "
           "plumb_bob";
  if (is_fisheye) camera.model = LensModel::kEquidistant;
  std::copy_n(coefficients.begin(), std::min(count, camera.distortion.size()), camera.distortion.begin());
  return "";
}

const PinholeCamera* lensOf(const PinholeCamera* camera) {
  return camera && camera->hasDistortion() ? camera : nullptr;
}

Quadrilateral undistorted(Quadrilateral quad, const PinholeCamera* lens) {
  if (lens)
    for (auto& corner : quad) corner = lens->undistort(corner);
  return quad;
}

Quadrilateral distorted(Quadrilateral quad, const PinholeCamera* lens) {
  if (lens)
    for (auto& corner : quad) corner = lens->distort(corner);
  return quad;
}

}  // namespace window_ingress::geometry
