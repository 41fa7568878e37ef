#include "window_ingress/detection/loop_judge.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

constexpr double kLoopTolerancePx = 0.6;  ///< uncertainty of a loop's position on the search level [px]
constexpr double kVariantOverlap =
    0.6;  ///< loops that overlap more, and are not round each other, are one window

}  // namespace

// One with some sides swapped for those of a neighbouring loop. Loops round each other are not.
bool LoopJudge::isVariant(const geometry::Quadrilateral& a, const geometry::Quadrilateral& b,
                          double tolerance_px) const {
  const double size = std::max(std::abs(geometry::signedArea(a)), std::abs(geometry::signedArea(b)));
  if ((geometry::centroid(a) - geometry::centroid(b)).squaredNorm() > size) return false;
  return geometry::intersectionOverUnion(a, b) > kVariantOverlap &&
         !isConcentric(a, b, tolerance_px, params_) && !isConcentric(b, a, tolerance_px, params_);
}

std::vector<Rival*> LoopJudge::bestOfVariants(std::vector<Rival>& rivals, double tolerance_px) const {
  std::vector<Rival*> loops;
  for (Rival& rival : rivals) {
    const auto better = std::find_if(loops.begin(), loops.end(), [&](const Rival* loop) {
      return isVariant(rival.quad, loop->quad, tolerance_px);
    });
    if (better == loops.end())
      loops.push_back(&rival);
    else
      rival.verdict.reject = RejectReason::kDuplicate;
  }
  return loops;
}

void LoopJudge::judge(const cv::Mat& image, int factor, std::vector<Rival>& rivals) const {
  const double tolerance_px = kLoopTolerancePx * factor;
  const std::vector<Rival*> loops = bestOfVariants(rivals, tolerance_px);
  std::vector<geometry::Quadrilateral> quads;
  std::vector<double> ranks;
  for (const Rival* loop : loops) quads.push_back(loop->quad), ranks.push_back(loop->rank());
  const auto verdicts = nested_.run(image, quads, ranks, tolerance_px);
  for (std::size_t i = 0; i < loops.size(); ++i) loops[i]->verdict = verdicts[i];
  // A frame is one thing: its inner border is as sure as its outer one.
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (verdicts[i].reject == RejectReason::kOuterBorder) {
      Rival& inner = *loops[verdicts[i].other];
      inner.score = std::max(inner.score, loops[i]->score);
    }
}

}  // namespace window_ingress::detection
