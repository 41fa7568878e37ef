#include "window_ingress/openness/opening_cells.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::openness {
namespace {

struct Range {
  int first, last;
};

Range cellsBetween(double from, double to, int side) {
  const int first = static_cast<int>(std::floor(from * side)), last = static_cast<int>(std::floor(to * side));
  return {std::clamp(first, 0, side - 1), std::clamp(last, 0, side - 1)};
}

// Cells that a middle part of the side reaches into.
Range middle(double needed, double whole, int side) {
  const double part = needed / whole;
  const double half = std::isfinite(part) ? 0.5 * std::clamp(part, 0.0, 1.0) : 0.5;
  constexpr double kTouch = 1e-6;
  Range range = cellsBetween(0.5 - half + kTouch, 0.5 + half - kTouch, side);
  range.first = std::min(range.first, side / 2 - 1);
  range.last = std::max(range.last, side / 2);
  return range;
}

}  // namespace

void OpeningCells::see(const Eigen::Vector2d& place, double log_odds) {
  if (!place.allFinite() || !std::isfinite(log_odds) || (place.array() < 0.0).any() ||
      (place.array() > 1.0).any())
    return;
  const int x = std::min(kSide - 1, static_cast<int>(place.x() * kSide));
  const int y = std::min(kSide - 1, static_cast<int>(place.y() * kSide));
  auto& cells = log_odds > 0.0 ? open_ : closed_;
  float& cell = cells[static_cast<std::size_t>(y * kSide + x)];
  cell = std::max(cell, static_cast<float>(std::abs(log_odds)));
}

OpeningCells::Share OpeningCells::shareOf(const geometry::OpeningSize& needed,
                                          const geometry::OpeningSize& opening) const {
  const Range across = middle(needed.width_m, opening.width_m, kSide);
  const Range down = middle(needed.height_m, opening.height_m, kSide);
  std::array<int, 4> cells{}, open{};
  int closed = 0;
  for (int y = down.first; y <= down.last; ++y)
    for (int x = across.first; x <= across.last; ++x) {
      const auto i = static_cast<std::size_t>(y * kSide + x);
      const std::size_t quarter = (y < kSide / 2 ? 0 : 2) + (x < kSide / 2 ? 0 : 1);
      const bool is_closed = closed_[i] >= kSure && closed_[i] >= open_[i];
      ++cells[quarter];
      open[quarter] += open_[i] >= kSure && !is_closed;
      closed += is_closed;
    }
  Share share{0.0, 0.0, 1.0};
  const int all = cells[0] + cells[1] + cells[2] + cells[3];
  share.open = static_cast<double>(open[0] + open[1] + open[2] + open[3]) / all;
  share.closed = static_cast<double>(closed) / all;
  for (int quarter = 0; quarter < 4; ++quarter)
    share.least_quarter_open =
        std::min(share.least_quarter_open, static_cast<double>(open[quarter]) / cells[quarter]);
  return share;
}

}  // namespace window_ingress::openness
