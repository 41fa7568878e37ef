#include "window_ingress/detection/target_borders.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

using geometry::Quadrilateral;

constexpr double kRingReach = 0.2;  ///< how far an edge may lie from where it is looked for, in ring widths
constexpr double kSmallestReachPx = 2.0;
constexpr double kStrayReach = 0.5;  ///< how far a border may lie from where it is foretold, in those reaches
constexpr double kSmallestStrayPx = 1.0;
constexpr double kOuterStrayPx = 3.0;     ///< how far the outer border may lie from its first fit [px]
constexpr double kForetoldSigmaPx = 0.3;  ///< how well the frame foretells [px]

double startRadiusPx(int factor) { return 1.5 * factor + 1.0; }

double reachPx(const Quadrilateral& outer, const Quadrilateral& inner) {
  const double ring_px = 0.5 * (std::sqrt(std::abs(geometry::signedArea(outer))) -
                                std::sqrt(std::abs(geometry::signedArea(inner))));
  return std::max(kSmallestReachPx, kRingReach * ring_px);
}

BorderStart outerStart(const Quadrilateral& outer, double reach_px) {
  return {outer, reach_px, EdgeChoice::kFirstOutward, kForetoldSigmaPx, kOuterStrayPx};
}

}  // namespace

std::optional<RefinedBorders> TargetBorders::seen(const cv::Mat& image, const Rival& rival, int factor,
                                                  const geometry::PinholeCamera* camera,
                                                  double* worst_inliers) const {
  return refinement_.run(image, {rival.quad, startRadiusPx(factor)}, camera, worst_inliers);
}

std::optional<RefinedBorders> TargetBorders::foretold(const cv::Mat& image, const Rival& rival,
                                                      const FrameModel& frame, int factor,
                                                      const geometry::PinholeCamera* camera,
                                                      double* worst_inliers) const {
  const auto rough = refinement_.run(image, {*rival.outer, startRadiusPx(factor)}, camera, worst_inliers);
  if (!rough) return std::nullopt;
  const double reach_px = reachPx(rough->corners, frame.inner(rough->corners));
  const auto outer = refinement_.run(image, outerStart(rough->corners, reach_px), camera, worst_inliers);
  if (!outer) return std::nullopt;
  const BorderStart inner = {frame.inner(outer->corners), reach_px, EdgeChoice::kFirstInward,
                             kForetoldSigmaPx, std::max(kSmallestStrayPx, kStrayReach * reach_px)};
  return refinement_.run(image, inner, camera, worst_inliers);
}

std::optional<FrameModel> TargetBorders::learn(const cv::Mat& picture, const Quadrilateral& opening,
                                               const std::vector<Rival>& loops, int factor,
                                               const NestedLoopsParams& params) const {
  std::vector<Quadrilateral> fitted;
  for (const Rival& loop : loops)
    if (const auto borders = seen(picture, loop, factor, nullptr, nullptr))
      fitted.push_back(borders->corners);
  const auto frame = findFrame(picture, opening, fitted, params);
  if (!frame) return std::nullopt;
  const auto outer =
      refinement_.run(picture, outerStart(frame->outer, reachPx(frame->outer, opening)), nullptr);
  return outer ? FrameModel(outer->corners, opening) : *frame;
}

}  // namespace window_ingress::detection
