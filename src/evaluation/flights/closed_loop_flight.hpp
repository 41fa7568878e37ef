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

/// Everything that flies: what a user's file says to the nodes; what it does not say of vehicle and opening
/// is taken from the world.
struct FlightParams : configuration::Overlay {
  bool without_images = false;  ///< the window is seen by `ProjectedDetector`, no image is drawn
};

/// The parameters with what is known of the vehicle and its target before the flight.
FlightParams withFactsOf(const simulation::World& world, FlightParams params);

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

/// One flight in one process, by the objects that the nodes use: the world's images through detector, pose
/// and filter to the navigator, and its setpoints back. Deterministic: scenario, seed and parameters give the
/// same result to the bit. The opening's size, the vehicle's body and its camera are known facts and taken
/// from the world, unless the operator says otherwise. \param timing the flight's is added to it \throws
/// InputError, std::invalid_argument (parameters), std::runtime_error (no renderer). Without
/// images, observers are not shown any.
FlightResult flyOnce(const simulation::Scenario& scenario, std::uint32_t seed, const FlightParams& params,
                     const std::vector<FlightObserver*>& observers = {}, FlightTiming* timing = nullptr);

}  // namespace window_ingress::evaluation
