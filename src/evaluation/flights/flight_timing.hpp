#pragma once

#include <array>
#include <chrono>
#include <string>

namespace window_ingress::evaluation {

/// Where the time of a closed-loop flight goes.
enum class Stage { kPhysics, kImage, kDetector, kPose, kNavigator, kOther };
constexpr std::size_t kStages = 6;

/// Wall time by stage. Looks on; a flight is the same with and without.
class FlightTiming {
 public:
  using Clock = std::chrono::steady_clock;

  /// Everything since the last call belonged to this stage.
  void lap(Stage stage);
  void begin() { last_ = Clock::now(); }
  void countFrame() { ++frames_; }
  void addSimulated(double sec) { simulated_sec_ += sec; }
  void add(const FlightTiming& other);

  double spentSec(Stage stage) const { return spent_sec_[static_cast<std::size_t>(stage)]; }
  double totalSec() const;
  double simulatedSec() const { return simulated_sec_; }
  long frames() const { return frames_; }

  /// A table for people: milliseconds a frame and share of each stage, times real time.
  std::string table() const;

 private:
  std::array<double, kStages> spent_sec_{};
  double simulated_sec_ = 0.0;
  long frames_ = 0;
  Clock::time_point last_ = Clock::now();
};

}  // namespace window_ingress::evaluation
