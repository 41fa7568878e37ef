#include "evaluation/images/truth_comparison.hpp"

#include <algorithm>
#include <cmath>

#include "evaluation/images/track_survey.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/median.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

constexpr double kTolerance_px = 3.0, kTolerance = 0.02;

bool showsWhole(const geometry::Quadrilateral& quad, const geometry::PinholeCamera& camera) {
  const auto inside = [&](const Eigen::Vector2d& corner) { return camera.contains(corner); };
  return std::all_of(quad.begin(), quad.end(), inside) && geometry::signedArea(quad) > 0.0;
}

double medianOf(std::vector<double> values) { return geometry::median(values); }

}  // namespace

double hitTolerance(const geometry::Quadrilateral& truth) {
  return std::max(kTolerance_px, kTolerance * geometry::meanSide(truth));
}

TruthErrors compareWithTruth(const std::optional<detection::WindowObservation>& window,
                             const std::optional<Eigen::Isometry3d>& estimate,
                             const Eigen::Isometry3d& T_camera_window, const geometry::PinholeCamera& camera,
                             const geometry::OpeningSize& opening) {
  TruthErrors errors;
  const Eigen::Matrix3d R_flu_window = geometry::R_optical_flu().transpose() * T_camera_window.linear();
  errors.true_distance_m = T_camera_window.translation().norm();
  errors.true_yaw_rad = geometry::yawOf(R_flu_window);
  const auto quad = geometry::projectOpening(camera, T_camera_window, opening);
  errors.whole = quad && showsWhole(*quad, camera);
  if (quad && geometry::signedArea(*quad) > 0.0 && geometry::isConvex(*quad)) errors.truth = *quad;
  errors.detected = window.has_value();
  if (window && window->whole()) errors.found = window->corners;
  if (errors.found && errors.truth)
    errors.iou = geometry::intersectionOverUnion(*errors.found, *errors.truth);
  if (window && !errors.found && errors.truth)
    errors.on_true_sides = worstSideDistance(*window, *errors.truth, camera) <= hitTolerance(*errors.truth);
  if (!estimate) return errors;
  errors.yaw_rad = geometry::yawOf(T_camera_window.linear().transpose() * estimate->linear());
  errors.distance_m = estimate->translation().norm() - errors.true_distance_m;
  return errors;
}

void TruthSummary::add(const TruthErrors& errors) {
  ++images;
  whole += errors.whole;
  const bool right = (errors.found && errors.iou >= kSameWindowIou) || errors.on_true_sides;
  const bool wrong = errors.detected && errors.iou < kOtherWindowIou && !errors.on_true_sides;
  (errors.whole ? found : partly) += right;
  (errors.whole ? exchanged : imagined) += wrong;
  if (!right || !errors.whole || !errors.found) return;
  corners.add(*errors.found, *errors.truth);
  if (!errors.yaw_rad) return;
  yaw_errors_rad.push_back(std::abs(*errors.yaw_rad));
  distance_errors_m.push_back(std::abs(*errors.distance_m));
}

std::string TruthSummary::text() const {
  std::string text = formatted(
      "%d images with truth, %d of them show the whole window\n"
      "whole window: found in %d (%.1f %%), something else mistaken for it in %d\n"
      "other images: found in %d, something else mistaken for it in %d\n",
      images, whole, found, whole > 0 ? 100.0 * found / whole : 0.0, exchanged, partly, imagined);
  if (corners.frames() > 0)
    text += formatted(
        "corners: RMS x %.3f y %.3f px, mean x %+.3f y %+.3f px, outward %+.3f px, median distance %.3f "
        "px, worst %.3f px (%d images)\n",
        corners.rms().x(), corners.rms().y(), corners.mean().x(), corners.mean().y(), corners.outward(),
        corners.median(), corners.worst(), corners.frames());
  if (!yaw_errors_rad.empty())
    text += formatted("median error of the yaw %.3f deg, of the distance %.4f m (%zu poses)\n",
                      medianOf(yaw_errors_rad) * geometry::kDegreesPerRad, medianOf(distance_errors_m),
                      yaw_errors_rad.size());
  if (found == 0 && exchanged > 0)
    text += "none lies where the truth says: do camera_info and the truth belong to these images?\n";
  return text;
}

}  // namespace window_ingress::evaluation
