#include "window_ingress/openness/opening_cells.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::openness {
namespace {

constexpr double kRim = 0.1;  // of a cell: a point in it may belong to the next cell

// Cells on either side of the middle: the needed middle part covers less than half of them.
int skipped(double needed, double whole, int side) {
  const double part = needed / whole;
  const double from = std::isfinite(part) ? 0.5 - 0.5 * std::clamp(part, 0.0, 1.0) : 0.0;
  return std::clamp(static_cast<int>(std::ceil(from * side - 0.5 - 1e-6)), 0, side / 2 - 1);
}

template <typename Cells>
double partOf(const Cells& cells) {
  return static_cast<double>(cells.count()) / static_cast<double>(cells.size());
}

}  // namespace

void OpeningCells::see(const Eigen::Vector2d& place, double log_odds) {
  if (!place.allFinite() || !std::isfinite(log_odds) || place.minCoeff() < 0.0 || place.maxCoeff() > 1.0)
    return;
  const float odds = std::min(kMax, static_cast<float>(std::abs(log_odds)));
  const double rim = log_odds > 0.0 ? kRim : 0.0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Eigen::Vector2d within = kSide * place - Eigen::Vector2d(x, y);
      if (within.minCoeff() < rim || within.maxCoeff() > 1.0 - rim) continue;
      float& cell = (log_odds > 0.0 ? open_ : closed_)(y, x);
      cell = std::max(cell, odds);
    }
}

void OpeningCells::seeBeside(std::uint64_t cells, double log_odds) {
  for (int i = 0; cells != 0 && i < kSide * kSide; ++i, cells >>= 1) {
    if ((cells & 1) == 0) continue;
    deep_(i / kSide, i % kSide) += log_odds >= kSure;
    shallow_(i / kSide, i % kSide) += log_odds < 0.0;
  }
}

void OpeningCells::endImage() {
  images_ = (shallow_ > 0).select(0, images_ + (deep_ >= kMinBeside).cast<int>());
  deep_.setZero(), shallow_.setZero();
}

OpeningCells::Share OpeningCells::shareOf(const geometry::OpeningSize& needed,
                                          const geometry::OpeningSize& opening) const {
  constexpr int kInner = kSide - 2;
  const Grid<bool> closed = closed_ >= kSure && closed_ >= open_;
  const Grid<bool> seen = !closed && (open_ >= kSure || images_ >= kMinImages);
  // Open is also what lies between two such cells, if nothing was seen in it.
  Grid<bool> open = seen;
  open.middleRows<kInner>(1) =
      open.middleRows<kInner>(1) || (seen.topRows<kInner>() && seen.bottomRows<kInner>());
  open.middleCols<kInner>(1) =
      open.middleCols<kInner>(1) || (seen.leftCols<kInner>() && seen.rightCols<kInner>());
  open = open && !closed;
  const int x = skipped(needed.width_m, opening.width_m, kSide), width = kSide - 2 * x;
  const int y = skipped(needed.height_m, opening.height_m, kSide), height = kSide - 2 * y;
  const auto middle = open.block(y, x, height, width);
  const auto upper = middle.topRows(height / 2), lower = middle.bottomRows(height / 2);
  return {partOf(middle), partOf(closed.block(y, x, height, width)),
          std::min({partOf(upper.leftCols(width / 2)), partOf(upper.rightCols(width / 2)),
                    partOf(lower.leftCols(width / 2)), partOf(lower.rightCols(width / 2))}),
          std::min({partOf(middle.row(0)), partOf(middle.row(height - 1)), partOf(middle.col(0)),
                    partOf(middle.col(width - 1))})};
}

}  // namespace window_ingress::openness
