#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
#include <string>

#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {

/// Where the time of a closed-loop flight goes.
enum class Stage { kPhysics, kImage, kDetector, kPose, kNavigator, kOther };
constexpr std::size_t kStages = 6;

/// Wall time by stage. Looks on; a flight is the same with and without.
class FlightTiming {
 public:
  using Clock = std::chrono::steady_clock;

  /// Everything since the last call belonged to this stage.
  void lap(Stage stage) {
    const auto now = Clock::now();
    spent_sec_[static_cast<std::size_t>(stage)] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

  void begin() { last_ = Clock::now(); }
  void countFrame() { ++frames_; }
  void addSimulated(double sec) { simulated_sec_ += sec; }
  void add(const FlightTiming& other) {
    for (std::size_t i = 0; i < kStages; ++i) spent_sec_[i] += other.spent_sec_[i];
    simulated_sec_ += other.simulated_sec_;
    frames_ += other.frames_;
  }

  double totalSec() const { return std::accumulate(spent_sec_.begin(), spent_sec_.end(), 0.0); }
  double simulatedSec() const { return simulated_sec_; }
  long frames() const { return frames_; }

  /// A table for people: milliseconds a frame and share of each stage, times real time.
  std::string table() const {
    const double total_sec = std::max(totalSec(), 1e-9);
    const double frames = static_cast<double>(std::max(frames_, 1L));
    std::string text = "| stage | ms a frame | share |\n|---|---|---|\n";
    for (std::size_t i = 0; i < kStages; ++i)
      text += formatted("| %s | %.2f | %.0f %% |\n", kNames[i], 1e3 * spent_sec_[i] / frames,
                        100.0 * spent_sec_[i] / total_sec);
    return text + formatted("| all | %.2f | %.2f times real time |\n", 1e3 * total_sec / frames,
                            simulated_sec_ / total_sec);
  }

 private:
  static constexpr const char* kNames[kStages] = {
      "physics, sensors, referee", "image: rendering, camera", "detector", "pose and filter", "navigator",
      "start, recording, the rest"};

  std::array<double, kStages> spent_sec_{};
  double simulated_sec_ = 0.0;
  long frames_ = 0;
  Clock::time_point last_ = Clock::now();
};

}  // namespace window_ingress::evaluation
