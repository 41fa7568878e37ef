/// Fits clicked corners to the edges near them, and reports those that lie on no edge.
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "window_ingress/detection/border_refinement.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::tools {

constexpr double kMaxShownPx = 1000.0;  // of the image on the screen, 300 more for the panel
constexpr double kFitRadiusPx = 6.0;    // on the screen
constexpr double kMaxMovedPx = 3.0;     // of a side by the fit, on the screen: clicks are more accurate
constexpr double kMaxMovedPart = 0.04;  // the same as part of the shortest side
constexpr double kNearPx = 3.0;         // on the screen: corners further from an edge are doubtful
constexpr double kMinOnEdge = 0.7;      // of each side, on one straight edge
const char* const kSides[] = {"top", "right", "bottom", "left"};

/// Result of a fit of the corners to the edges near them.
struct CornerFit {
  std::vector<double> corners;  ///< empty: the fit failed
  std::string said;             ///< how far each side moves, or why the fit is refused
};

inline CornerFit noFit(const std::string& why) { return {{}, why}; }

// How far the ends of the side that begins at this corner have moved [px].
inline double sideMovedPx(const geometry::Quadrilateral& from, const geometry::Quadrilateral& to,
                          std::size_t side) {
  const Eigen::Vector2d begin = to[side], along = (to[(side + 1) % 4] - begin).normalized();
  const auto across = [&](const Eigen::Vector2d& point) {
    return std::abs(along.x() * (point - begin).y() - along.y() * (point - begin).x());
  };
  return std::max(across(from[side]), across(from[(side + 1) % 4]));
}

inline double shortestSide(const geometry::Quadrilateral& quad) {
  double shortest_px = (quad[0] - quad[3]).norm();
  for (std::size_t i = 0; i < 3; ++i) shortest_px = std::min(shortest_px, (quad[i + 1] - quad[i]).norm());
  return shortest_px;
}

/// Fits to the strongest edges within `radius_px` on the screen. Refused if a side finds no edge, or one too
/// far away for a click.
inline CornerFit fittedWithin(double radius_px, const cv::Mat& image, const std::vector<double>& corners) {
  geometry::Quadrilateral quad;
  for (std::size_t i = 0; i < 4; ++i) quad[i] = {corners[2 * i], corners[2 * i + 1]};
  const auto clicked = geometry::canonical(quad);
  if (!clicked) return noFit("the corners are not a convex quadrilateral");
  const double scale = std::max(1.0, std::max(image.cols, image.rows) / kMaxShownPx);
  double on_edge = 0.0;
  const auto borders = detection::refineBorders(image, {*clicked, radius_px * scale}, nullptr, &on_edge);
  if (on_edge < kMinOnEdge)
    return noFit(formatted("only %.0f %% of one side lie on a straight edge near it", 100.0 * on_edge));
  if (!borders) return noFit("the straight edge near one side leads away from its corners");
  const double most_px = std::min(kMaxMovedPx * scale, kMaxMovedPart * shortestSide(*clicked));
  CornerFit fit;
  for (std::size_t side = 0; side < 4; ++side) {
    const double moved_px = sideMovedPx(*clicked, borders->corners, side);
    if (!(moved_px <= most_px))
      return noFit(
          formatted("the %s side would move by %.1f px, more than %.1f, so it lies beside the inner edge",
                    kSides[side], moved_px, most_px));
    fit.said += formatted("%s%s %.1f px", side == 0 ? "" : ", ", kSides[side], moved_px);
  }
  for (const auto& corner : borders->corners) fit.corners.insert(fit.corners.end(), {corner.x(), corner.y()});
  return fit;
}

/// A deep frame has two parallel edges, and the further one may be the stronger: near edges are tried first.
inline CornerFit fitted(const cv::Mat& image, const std::vector<double>& corners) {
  const CornerFit near = fittedWithin(kNearPx, image, corners);
  return near.corners.empty() ? fittedWithin(kFitRadiusPx, image, corners) : near;
}

/// Distance of unfitted corners from the edges near them; no edges are near poor corners.
inline CornerFit besideEdges(const cv::Mat& image, const std::vector<double>& corners) {
  CornerFit fit = fittedWithin(kNearPx, image, corners);
  fit.said = (fit.corners.empty() ? "poor corners: " : "beside the edges near them: ") + fit.said;
  return fit;
}

}  // namespace window_ingress::tools
