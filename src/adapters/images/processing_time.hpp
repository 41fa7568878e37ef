#pragma once

#include <std_msgs/Header.h>

#include <array>
#include <optional>

#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/detection/stage_timer.hpp"

namespace window_ingress::adapters {

/// What the detector's images cost, stage by stage, beside what they may cost.
class ProcessingTime {
 public:
  /// \param budget_ms for one image; 0: the time between two images of the camera
  /// \param clock seconds that never go back
  ProcessingTime(double budget_ms, detection::StageTimer::Clock clock)
      : watch_(clock), clock_(clock), budget_ms_(budget_ms) {}

  detection::StageTimer& watch() { return watch_; }

  /// An image has come. \param decode_ms spent on it before
  void begin(const std_msgs::Header& header, double decode_ms);
  /// \return milliseconds since `begin`
  double sinceBegin() const { return 1e3 * (clock_() - begun_sec_); }
  /// The image is done, drawing it for people included.
  void end();

  Health health() const;

 private:
  double budgetMs() const { return budget_ms_ > 0.0 ? budget_ms_ : period_ms_; }
  void notePeriod(const std_msgs::Header& header);

  detection::StageTimer watch_;
  detection::StageTimer::Clock clock_;
  double budget_ms_, begun_sec_ = 0.0, decode_ms_ = 0.0;
  double whole_ms_ = 0.0, decoding_ms_ = 0.0, slowest_ms_ = 0.0;  // but for the last: means of late
  double period_ms_ = 0.0;
  std::array<double, detection::kStages> stage_ms_{};  // means of late
  std::optional<std_msgs::Header> before_;
  long images_ = 0;
};

}  // namespace window_ingress::adapters
