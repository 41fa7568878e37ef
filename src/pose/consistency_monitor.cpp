#include "window_ingress/pose/consistency_monitor.hpp"

#include <cmath>

namespace window_ingress::pose {

void ConsistencyMonitor::add(double squares, int degrees_of_freedom) {
  if (!std::isfinite(squares) || squares < 0.0 || degrees_of_freedom < 1) return;
  samples_.push_back({squares, degrees_of_freedom});
  if (samples_.size() > images_) samples_.pop_front();
}

Consistency ConsistencyMonitor::consistency() const {
  Consistency out;
  double squares = 0.0, degrees_of_freedom = 0.0;
  for (const Sample& sample : samples_) {
    squares += sample.squares;
    degrees_of_freedom += sample.degrees_of_freedom;
  }
  out.images = static_cast<int>(samples_.size());
  if (degrees_of_freedom > 0.0) out.mean_nis = squares / degrees_of_freedom;
  out.consistent = 2 * samples_.size() < images_ || out.mean_nis <= limit_;
  return out;
}

}  // namespace window_ingress::pose
