#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/images/corner_statistics.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::evaluation {

/// Limits for a correct detection.
constexpr double kSameWindowIou = 0.7;   ///< at least this: the right window was found
constexpr double kOtherWindowIou = 0.5;  ///< below this: something else was detected as the window
/// Tolerance of each corner: 3 px or 2 % of the true border's mean side, whichever is more [px].
double hitTolerance(const geometry::Quadrilateral& truth);

/// One image compared with the truth.
struct TruthErrors {
  bool whole = false;  ///< the image shows the opening whole, from its front
  double iou = 0.0;    ///< of the detected with the true quadrilateral, if the opening is seen from its front
  std::optional<geometry::Quadrilateral> truth;  ///< the opening's border, if seen from its front
  bool detected = false;
  std::optional<geometry::Quadrilateral> found;  ///< the detected quadrilateral, if all its corners are seen
  /// For a partial detection: its sides lie on the true ones within `hitTolerance`.
  bool on_true_sides = false;
  double true_distance_m = 0.0;      ///< camera to the opening's centre
  double true_yaw_rad = 0.0;         ///< of the window's axis against the camera's, positive to the left
  std::optional<double> yaw_rad;     ///< error about the window's vertical, if there is a pose
  std::optional<double> distance_m;  ///< error of the distance, if there is a pose
};

/// \param T_camera_window the truth
/// \param estimate the pose found, or nothing
TruthErrors compareWithTruth(const std::optional<detection::WindowObservation>& window,
                             const std::optional<Eigen::Isometry3d>& estimate,
                             const Eigen::Isometry3d& T_camera_window, const geometry::PinholeCamera& camera,
                             const geometry::OpeningSize& opening);

/// Many images.
struct TruthSummary {
  int images = 0;
  int whole = 0;             ///< images that show the opening whole
  int found = 0;             ///< images of these in which the right window was found
  int exchanged = 0;         ///< images of these in which something else was detected as the window
  int partly = 0;            ///< images that do not show it whole, but in which it was found
  int imagined = 0;          ///< images that do not show it whole, and in which something else was detected
  CornerStatistics corners;  ///< of the images that show the opening whole and in which it was found
  std::vector<double> yaw_errors_rad, distance_errors_m;  ///< magnitudes, of the same images

  void add(const TruthErrors& errors);
  std::string text() const;  ///< one line per figure, for people
};

}  // namespace window_ingress::evaluation
