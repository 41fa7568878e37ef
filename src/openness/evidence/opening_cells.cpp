#include "window_ingress/openness/opening_cells.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::openness {
namespace {

constexpr double kRim = 0.1;  // of a cell: a point in it may belong to the next cell

using Range = OpeningCells::Range;

// Cells that the needed middle part of the side covers at least half.
Range middle(double needed, double whole, int side) {
  const double part = needed / whole;
  const double from = std::isfinite(part) ? 0.5 - 0.5 * std::clamp(part, 0.0, 1.0) : 0.0;
  const int first = std::min(side / 2 - 1, static_cast<int>(std::ceil(from * side - 0.5 - 1e-6)));
  return {std::max(0, first), side - 1 - std::max(0, first)};
}

}  // namespace

void OpeningCells::see(const Eigen::Vector2d& place, double log_odds) {
  if (!place.allFinite() || !std::isfinite(log_odds) || (place.array() < 0.0).any() ||
      (place.array() > 1.0).any())
    return;
  const float odds = std::min(kMax, static_cast<float>(std::abs(log_odds)));
  const double rim = log_odds > 0.0 ? kRim : 0.0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Eigen::Vector2d within = kSide * place - Eigen::Vector2d(x, y);
      if (within.minCoeff() < rim || within.maxCoeff() > 1.0 - rim) continue;
      float& cell = (log_odds > 0.0 ? open_ : closed_)[static_cast<std::size_t>(y * kSide + x)];
      cell = std::max(cell, odds);
    }
}

void OpeningCells::seeBeside(std::uint64_t cells, double log_odds) {
  for (std::size_t i = 0; cells != 0 && i < deep_.size(); ++i, cells >>= 1) {
    if ((cells & 1) == 0) continue;
    deep_[i] += log_odds >= kSure;
    shallow_[i] += log_odds < 0.0;
  }
}

void OpeningCells::endImage() {
  for (std::size_t i = 0; i < deep_.size(); ++i) {
    if (shallow_[i] > 0)
      images_[i] = 0;
    else
      images_[i] += deep_[i] >= kMinBeside;
  }
  deep_.fill(0), shallow_.fill(0);
}

bool OpeningCells::isClosed(int x, int y) const {
  const auto i = static_cast<std::size_t>(y * kSide + x);
  return closed_[i] >= kSure && closed_[i] >= open_[i];
}

bool OpeningCells::isOpen(int x, int y) const {
  if (x < 0 || y < 0 || x >= kSide || y >= kSide || isClosed(x, y)) return false;
  const auto i = static_cast<std::size_t>(y * kSide + x);
  return open_[i] >= kSure || images_[i] >= kMinImages;
}

// True if nothing was seen through the cell itself, but on two opposite sides of it.
bool OpeningCells::isBetweenOpen(int x, int y) const {
  return !isClosed(x, y) &&
         ((isOpen(x - 1, y) && isOpen(x + 1, y)) || (isOpen(x, y - 1) && isOpen(x, y + 1)));
}

double OpeningCells::openOf(const Range& across, const Range& down) const {
  int open = 0;
  for (int y = down.first; y <= down.last; ++y)
    for (int x = across.first; x <= across.last; ++x) open += isOpen(x, y) || isBetweenOpen(x, y);
  return static_cast<double>(open) / ((down.last - down.first + 1) * (across.last - across.first + 1));
}

OpeningCells::Share OpeningCells::shareOf(const geometry::OpeningSize& needed,
                                          const geometry::OpeningSize& opening) const {
  const Range across = middle(needed.width_m, opening.width_m, kSide);
  const Range down = middle(needed.height_m, opening.height_m, kSide);
  std::array<int, 4> cells{}, open{};
  int closed = 0;
  for (int y = down.first; y <= down.last; ++y)
    for (int x = across.first; x <= across.last; ++x) {
      const std::size_t quarter = (y < kSide / 2 ? 0 : 2) + (x < kSide / 2 ? 0 : 1);
      ++cells[quarter];
      open[quarter] += isOpen(x, y) || isBetweenOpen(x, y);
      closed += isClosed(x, y);
    }
  Share share{0.0, 0.0, 1.0, 1.0};
  const int all = cells[0] + cells[1] + cells[2] + cells[3];
  share.open = static_cast<double>(open[0] + open[1] + open[2] + open[3]) / all;
  share.closed = static_cast<double>(closed) / all;
  for (int quarter = 0; quarter < 4; ++quarter)
    share.least_quarter_open =
        std::min(share.least_quarter_open, static_cast<double>(open[quarter]) / cells[quarter]);
  for (const double side :
       {openOf({across.first, across.first}, down), openOf({across.last, across.last}, down),
        openOf(across, {down.first, down.first}), openOf(across, {down.last, down.last})})
    share.least_side_open = std::min(share.least_side_open, side);
  return share;
}

}  // namespace window_ingress::openness
