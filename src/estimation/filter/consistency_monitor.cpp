#include "window_ingress/estimation/consistency_monitor.hpp"

#include <cmath>

namespace window_ingress::estimation {
namespace {

constexpr double kMaxRefused = 0.4;

}  // namespace

void ConsistencyMonitor::add(double squares, int degrees_of_freedom) {
  if (!std::isfinite(squares) || squares < 0.0 || degrees_of_freedom < 1) return;
  note({squares, degrees_of_freedom});
}

void ConsistencyMonitor::note(const Sample& sample) {
  samples_.push_back(sample);
  if (samples_.size() > std::size_t{kImages}) samples_.pop_front();
}

Consistency ConsistencyMonitor::consistency() const {
  Consistency out;
  double squares = 0.0, degrees_of_freedom = 0.0;
  for (const Sample& sample : samples_) {
    squares += sample.squares;
    degrees_of_freedom += sample.degrees_of_freedom;
    out.refused += sample.degrees_of_freedom == 0;
  }
  const int seen = static_cast<int>(samples_.size());
  out.images = seen - out.refused;
  if (degrees_of_freedom > 0.0) out.mean_nis = squares / degrees_of_freedom;
  const bool few = 2 * seen < kImages;
  out.consistent = few || out.mean_nis <= kMaxMeanNis;
  out.contradicted = !few && out.refused > kMaxRefused * seen;
  return out;
}

}  // namespace window_ingress::estimation
