#include "adapters/images/processing_time.hpp"

#include <algorithm>
#include <string>

#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kTimeSmoothing = 0.1;
constexpr double kLongestPeriodMs = 2000.0;  // beyond that the camera has paused

}  // namespace

void ProcessingTime::begin(const std_msgs::Header& header, double decode_ms) {
  notePeriod(header);
  decode_ms_ = decode_ms;
  begun_sec_ = clock_();
  watch_.begin();
}

// Images that are dropped for want of time are counted by their numbers.
void ProcessingTime::notePeriod(const std_msgs::Header& header) {
  if (before_) {
    const double since_ms = 1e3 * (header.stamp.toSec() - before_->stamp.toSec());
    const double numbers = header.seq > before_->seq ? header.seq - before_->seq : 1.0;
    const double period_ms = since_ms / numbers;
    if (period_ms > 0.0 && period_ms < kLongestPeriodMs)
      period_ms_ += (period_ms_ > 0.0 ? kTimeSmoothing : 1.0) * (period_ms - period_ms_);
  }
  before_ = header;
}

void ProcessingTime::end() {
  const double part = images_++ == 0 ? 1.0 : kTimeSmoothing, whole_ms = decode_ms_ + sinceBegin();
  whole_ms_ += part * (whole_ms - whole_ms_);
  decoding_ms_ += part * (decode_ms_ - decoding_ms_);
  slowest_ms_ = std::max(slowest_ms_, whole_ms);
  for (int i = 0; i < detection::kStages; ++i)
    stage_ms_[i] += part * (watch_.milliseconds(static_cast<detection::Stage>(i)) - stage_ms_[i]);
}

Health ProcessingTime::health() const {
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

}  // namespace window_ingress::adapters
