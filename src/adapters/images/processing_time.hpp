#pragma once

#include <std_msgs/Header.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/detection/stage_timer.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

/// Processing time of the detector's images per stage, compared with the budget.
class ProcessingTime {
 public:
  /// \param budget_ms per image; 0: the camera's period
  /// \param clock monotonic, seconds
  ProcessingTime(double budget_ms, detection::StageTimer::Clock clock)
      : timer_(clock), clock_(clock), budget_ms_(budget_ms) {}

  detection::StageTimer& timer() { return timer_; }

  /// Starts an image. \param decode_ms decoding time before this call
  void begin(const std_msgs::Header& header, double decode_ms) {
    notePeriod(header.seq);
    decode_ms_ = decode_ms;
    timer_.begin();
  }

  /// \return milliseconds since `begin`
  double sinceBegin() const { return 1e3 * (clock_() - begun_sec_); }
  /// Ends an image, after the debug image was drawn.
  void end() {
    const double part = images_++ == 0 ? 1.0 : kTimeSmoothing, whole_ms = decode_ms_ + sinceBegin();
    whole_ms_ += part * (whole_ms - whole_ms_);
    decoding_ms_ += part * (decode_ms_ - decoding_ms_);
    slowest_ms_ = std::max(slowest_ms_, whole_ms);
    for (int i = 0; i < detection::kStages; ++i)
      stage_ms_[i] += part * (timer_.milliseconds(static_cast<detection::Stage>(i)) - stage_ms_[i]);
  }

  Health health() const {
    if (images_ == 0) return {Health::kOk, "no image so far"};
    Health health;
    health.values = {{"whole_ms", whole_ms_},
                     {"slowest_ms", slowest_ms_},
                     {"budget_ms", budgetMs()},
                     {"decode_ms", decoding_ms_}};
    for (int i = 0; i < detection::kStages; ++i)
      health.values.emplace_back(std::string(detection::toString(static_cast<detection::Stage>(i))) + "_ms",
                                 stage_ms_[i]);
    const bool slow = budgetMs() > 0.0 && whole_ms_ > budgetMs();
    const auto most = std::max_element(stage_ms_.begin(), stage_ms_.end()) - stage_ms_.begin();
    health.text = formatted(
        slow ? "%.1f ms an image, the budget is %.1f ms: images are dropped; most goes into '%s' (%.1f ms)"
             : "%.1f ms an image of %.1f ms; most goes into '%s' (%.1f ms)",
        whole_ms_, budgetMs(), detection::toString(static_cast<detection::Stage>(most)), stage_ms_[most]);
    if (slow) health.level = Health::kWarn;
    return health;
  }

 private:
  static constexpr double kTimeSmoothing = 0.1;
  /// A period longer than this many ends a pause of the camera; two in a row mean a slower camera.
  static constexpr double kPausePeriods = 3.0;

  double budgetMs() const { return budget_ms_ > 0.0 ? budget_ms_ : period_ms_; }
  // Measured by the clock of the work, because a bag may be played slowly. The numbers of images count those
  // that were dropped for lack of time.
  void notePeriod(std::uint32_t number) {
    const double now_sec = clock_();
    if (images_ > 0) {
      const double period_ms = 1e3 * (now_sec - begun_sec_) / (number > number_ ? number - number_ : 1);
      paused_ = !paused_ && period_ms_ > 0.0 && period_ms > kPausePeriods * period_ms_;
      if (!paused_) period_ms_ += (period_ms_ > 0.0 ? kTimeSmoothing : 1.0) * (period_ms - period_ms_);
    }
    number_ = number;
    begun_sec_ = now_sec;
  }

  detection::StageTimer timer_;
  detection::StageTimer::Clock clock_;
  double budget_ms_, begun_sec_ = 0.0, decode_ms_ = 0.0;
  double whole_ms_ = 0.0, decoding_ms_ = 0.0, slowest_ms_ = 0.0;  // recent means, except for the last
  double period_ms_ = 0.0;
  bool paused_ = false;
  std::array<double, detection::kStages> stage_ms_{};  // recent means
  std::uint32_t number_ = 0;                           // of the last image
  long images_ = 0;
};

}  // namespace window_ingress::adapters
