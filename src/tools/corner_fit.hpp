/// Fits clicked corners to the edges near them, and says what speaks against those that lie on none.
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

constexpr double kMaxShownPx = 1000.0;  // of the image on the screen: 300 more are the panel's
constexpr double kFitRadiusPx = 6.0;    // on the screen
constexpr double kMaxMovedPx = 3.0;     // of a side by the fit, on the screen: clicks are better than that
constexpr double kMaxMovedPart = 0.04;  // the same as part of the shortest side
constexpr double kNearPx = 3.0;         // on the screen: corners further from an edge are doubtful
constexpr double kMinOnEdge = 0.7;      // of each side, on one straight edge
const char* const kSides[] = {"top", "right", "bottom", "left"};

/// What became of an attempt to fit the corners to the edges near them.
struct CornerFit {
  std::vector<double> corners;  ///< empty: none to be trusted
  std::string said;             ///< by how much each side moves, or why the fit is refused
};

inline CornerFit noFit(const std::string& why) { return {{}, why}; }

// How far the side that begins at this corner has moved, at its ends [px].
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

/// To the strongest edges within `radius_px` on the screen. A side that finds none, or one that lies further
/// away than anybody clicks, is not the one that is meant.
inline CornerFit fittedWithin(double radius_px, const cv::Mat& image, const std::vector<double>& corners) {
  geometry::Quadrilateral quad;
  for (std::size_t i = 0; i < 4; ++i) quad[i] = {corners[2 * i], corners[2 * i + 1]};
  const auto clicked = geometry::canonical(quad);
  if (!clicked) return noFit("the corners make no convex quadrilateral");
  const double scale = std::max(1.0, std::max(image.cols, image.rows) / kMaxShownPx);
  double on_edge = 0.0;
  const auto borders =
      detection::BorderRefinement().run(image, {*clicked, radius_px * scale}, nullptr, &on_edge);
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

/// A deep frame has two edges side by side, and the further one may be the stronger: what lies near comes
/// first.
inline CornerFit fitted(const cv::Mat& image, const std::vector<double>& corners) {
  const CornerFit near = fittedWithin(kNearPx, image, corners);
  return near.corners.empty() ? fittedWithin(kFitRadiusPx, image, corners) : near;
}

/// How far corners that are saved as they are lie from the edges near them; none are near poor corners.
inline CornerFit besideEdges(const cv::Mat& image, const std::vector<double>& corners) {
  CornerFit fit = fittedWithin(kNearPx, image, corners);
  fit.said = (fit.corners.empty() ? "poor corners: " : "beside the edges near them: ") + fit.said;
  return fit;
}

}  // namespace window_ingress::tools
