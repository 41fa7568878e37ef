#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "window_ingress/geometry/finite_math.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::geometry {

/// Lens distortion models, as sensor_msgs/CameraInfo names them.
enum class LensModel {
  kPlumbBob,    ///< radial and tangential: k1, k2, p1, p2, k3
  kEquidistant  ///< fisheye: angle theta off the axis is seen at theta (1 + k1 theta^2 + .. + k4 theta^8)
};

/// Pinhole camera with lens distortion.
///
/// Pixel centres are integers: the top left pixel's centre is (0, 0), and an ideal camera has its principal
/// point at ((width - 1) / 2, (height - 1) / 2).
struct PinholeCamera {
  int width = 0;                                  ///< [px]
  int height = 0;                                 ///< [px]
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< [px]
  std::array<double, 5> distortion{};  ///< in the model's order: k1, k2, p1, p2, k3, or k1, k2, k3, k4, 0
  LensModel model = LensModel::kPlumbBob;

  bool operator==(const PinholeCamera& other) const {
    const auto key = [](const PinholeCamera& c) {
      return std::tie(c.width, c.height, c.fx, c.fy, c.cx, c.cy, c.distortion, c.model);
    };
    return key(*this) == key(other);
  }

  /// Ideal camera, square pixels, centred principal point, no distortion.
  static PinholeCamera fromFieldOfView(int width_px, int height_px, double horizontal_fov_rad);

  /// Faults of this calibration, one text each; empty if it can be used.
  std::vector<std::string> validate() const;

  bool hasDistortion() const;
  PinholeCamera withoutDistortion() const;  ///< the same K, and straight lines stay straight
  Eigen::Matrix3d K() const;

  /// Pixel of a point in the optical frame [m]; nothing for points not in front of the camera.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_camera) const;

  /// Point of the image plane at distance 1 under an ideal (undistorted) pixel.
  Eigen::Vector2d normalised(const Eigen::Vector2d& ideal_px) const {
    return {(ideal_px.x() - cx) / fx, (ideal_px.y() - cy) / fy};
  }

  /// Distorted pixel of an ideal (undistorted) pixel of the same K.
  Eigen::Vector2d distort(const Eigen::Vector2d& ideal_px) const;

  /// Derivative of `distort` at an ideal pixel.
  Eigen::Matrix2d distortionSlope(const Eigen::Vector2d& ideal_px) const;

  /// Width of one image pixel in ideal pixels, across a straight line of the ideal image through a point in a
  /// direction (of any length). It is 1 without distortion, and 4 at 60 degrees off a fisheye's axis for a
  /// line tangential to the axis.
  double pixelAcross(const Eigen::Vector2d& ideal_px, const Eigen::Vector2d& along) const;

  /// Ideal pixel of a distorted one, by Newton iterations; accurate to 1e-6 px within the image of any sane
  /// lens. Fisheye directions beyond 1.5 rad off the axis have no ideal pixel and get that of 1.5 rad.
  Eigen::Vector2d undistort(const Eigen::Vector2d& distorted_px) const;

  /// Line of sight (unit vector, optical frame) of an image pixel.
  Eigen::Vector3d ray(const Eigen::Vector2d& distorted_px) const;

  /// True if the pixel lies in the image, at least `margin_px` inside its border.
  bool contains(const Eigen::Vector2d& pixel, double margin_px = 0.0) const;
};

/// Sets a camera's lens from a model's name and coefficients, as calibration files and sensor_msgs/CameraInfo
/// give them: plumb_bob with 4 or 5 numbers, equidistant (or fisheye) with 4, rational_polynomial with 8 of
/// which the last three are 0. Without numbers, or with zeros alone, plumb_bob, rational_polynomial and a
/// model without a name are a lens without distortion. \return why the lens cannot be used, empty if it can
std::string setLens(const std::string& model, const std::vector<double>& coefficients, PinholeCamera& camera);

/// The camera if its lens distorts the image, else null.
const PinholeCamera* lensOf(const PinholeCamera* camera);

/// Convert corners between raw and undistorted image. \param lens null: no distortion
Quadrilateral undistorted(Quadrilateral quad, const PinholeCamera* lens);
Quadrilateral distorted(Quadrilateral quad, const PinholeCamera* lens);

}  // namespace window_ingress::geometry
