#include "window_ingress/detection/frame_model.hpp"

#include <cmath>
#include <limits>

#include "window_ingress/detection/unit_square.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kThinnest = 0.012;  ///< narrowest frame that is believed, in mean sides of the opening

bool isFrame(const cv::Mat& picture, const geometry::Quadrilateral& outer,
             const geometry::Quadrilateral& opening, const NestedLoopsParams& params) {
  const double side = std::sqrt(std::abs(geometry::signedArea(opening)));
  const double growth = std::sqrt(std::abs(geometry::signedArea(outer))) - side;
  return growth > 2.0 * kThinnest * side && isConcentric(outer, opening, 0.5, params) &&
         measureRing(picture, outer, opening).spread < params.uniform;
}

}  // namespace

FrameModel::FrameModel(const geometry::Quadrilateral& outer_seen, const geometry::Quadrilateral& opening)
    : outer(outer_seen) {
  const UnitSquare square(outer);
  for (int i = 0; i < 4; ++i) inner_in_outer[i] = square.fromImage(opening[i]);
}

geometry::Quadrilateral FrameModel::inner(const geometry::Quadrilateral& outer_seen) const {
  const UnitSquare square(outer_seen);
  geometry::Quadrilateral quad;
  for (int i = 0; i < 4; ++i) quad[i] = square.toImage(inner_in_outer[i]);
  return quad;
}

std::optional<FrameModel> findFrame(const cv::Mat& picture, const geometry::Quadrilateral& opening,
                                    const std::vector<geometry::Quadrilateral>& loops,
                                    const NestedLoopsParams& params) {
  const geometry::Quadrilateral* frame = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const geometry::Quadrilateral& loop : loops) {
    const double area = std::abs(geometry::signedArea(loop));
    if (area < least && isFrame(picture, loop, opening, params)) least = area, frame = &loop;
  }
  if (!frame) return std::nullopt;
  return FrameModel(*frame, opening);
}

}  // namespace window_ingress::detection
