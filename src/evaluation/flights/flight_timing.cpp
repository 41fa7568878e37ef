#include "evaluation/flights/flight_timing.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace window_ingress::evaluation {
namespace {

constexpr Stage kAll[kStages] = {Stage::kPhysics, Stage::kImage,     Stage::kDetector,
                                 Stage::kPose,    Stage::kNavigator, Stage::kOther};

}  // namespace

const char* toString(Stage stage) {
  switch (stage) {
    case Stage::kPhysics:
      return "physics, sensors, referee";
    case Stage::kImage:
      return "image: rendering, camera";
    case Stage::kDetector:
      return "detector";
    case Stage::kPose:
      return "pose and filter";
    case Stage::kNavigator:
      return "navigator";
    case Stage::kOther:
      return "start, recording, the rest";
  }
  return "unknown";
}

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
  char row[120];
  std::string text = "| stage | ms a frame | share |\n|---|---|---|\n";
  for (const Stage stage : kAll) {
    std::snprintf(row, sizeof row, "| %s | %.2f | %.0f %% |\n", toString(stage),
                  1e3 * spentSec(stage) / frames, 100.0 * spentSec(stage) / total_sec);
    text += row;
  }
  std::snprintf(row, sizeof row, "| all | %.2f | %.2f times real time |\n", 1e3 * total_sec / frames,
                simulated_sec_ / total_sec);
  return text + row;
}

}  // namespace window_ingress::evaluation
