#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "evaluation/flights/flight_observer.hpp"
#include "evaluation/flights/flight_results.hpp"
#include "simulation/world.hpp"
#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {

/// Parameters of a flight: the nodes' from a user's file; values of vehicle and opening that it does not give
/// come from the world.
struct FlightParams : configuration::Overlay {
  bool without_images = false;  ///< `ProjectedDetector` detects the window, no image is rendered
};

/// Stages of a closed-loop flight whose time is measured.
enum class Stage { kPhysics, kImage, kDetector, kPose, kNavigator, kOther };
constexpr std::size_t kStages = 6;

/// Wall time by stage. Does not change the flight.
class FlightTiming {
 public:
  using Clock = std::chrono::steady_clock;

  /// Adds the time since the last call to this stage.
  void lap(Stage stage) {
    const auto now = Clock::now();
    spent_sec_[static_cast<std::size_t>(stage)] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

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

  /// A table for people: milliseconds per frame and share of each stage, and speed over real time.
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

/// One flight in one process with the objects that the nodes use: the world's images go through detector,
/// pose and filter to the navigator, and its setpoints go back. Deterministic: scenario, seed and parameters
/// give a bit-identical result. Opening size, vehicle body and camera come from the world unless the operator
/// gives others. Without images, observers get none.
/// \param timing the times of this flight are added
/// \throws InputError, std::invalid_argument (parameters), std::runtime_error (no renderer)
FlightResult flyOnce(const simulation::Scenario& scenario, std::uint32_t seed, const FlightParams& params,
                     const std::vector<FlightObserver*>& observers = {}, FlightTiming* timing = nullptr);

}  // namespace window_ingress::evaluation
