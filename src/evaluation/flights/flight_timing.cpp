#include "evaluation/flights/flight_timing.hpp"

#include <algorithm>
#include <numeric>

#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

constexpr const char* kNames[kStages] = {
    "physics, sensors, referee", "image: rendering, camera", "detector", "pose and filter", "navigator",
    "start, recording, the rest"};

}  // namespace

void FlightTiming::lap(Stage stage) {
  const auto now = Clock::now();
  spent_sec_[static_cast<std::size_t>(stage)] += std::chrono::duration<double>(now - last_).count();
  last_ = now;
}

void FlightTiming::add(const FlightTiming& other) {
  for (std::size_t i = 0; i < kStages; ++i) spent_sec_[i] += other.spent_sec_[i];
  simulated_sec_ += other.simulated_sec_;
  frames_ += other.frames_;
}

double FlightTiming::totalSec() const { return std::accumulate(spent_sec_.begin(), spent_sec_.end(), 0.0); }

std::string FlightTiming::table() const {
  const double total_sec = std::max(totalSec(), 1e-9);
  const double frames = static_cast<double>(std::max(frames_, 1L));
  std::string text = "| stage | ms a frame | share |\n|---|---|---|\n";
  for (std::size_t i = 0; i < kStages; ++i)
    text += formatted("| %s | %.2f | %.0f %% |\n", kNames[i], 1e3 * spent_sec_[i] / frames,
                      100.0 * spent_sec_[i] / total_sec);
  return text + formatted("| all | %.2f | %.2f times real time |\n", 1e3 * total_sec / frames,
                          simulated_sec_ / total_sec);
}

}  // namespace window_ingress::evaluation
