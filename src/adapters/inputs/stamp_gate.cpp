#include "adapters/inputs/stamp_gate.hpp"

#include "adapters/conversions/stamps.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

// A player publishes no clock while it unpacks a chunk of the bag, and then sends all due messages at once.
constexpr const char* kSlowPlayer =
    "; if a bag is played, its player is too slow: rosbag decompress the bag, or play at rate:=0.3";

}  // namespace

std::optional<std::string> StampGate::whyRefused(const ros::Time& stamp, double now_sec) {
  const std::optional<double> sec = stampSec(stamp);
  if (!sec) return "header.stamp is zero or not normalised; the source must stamp its messages";
  const double age_sec = now_sec - *sec;
  if (age_sec > 86400.0)
    return formatted(
        "stamp is %.0f days old; recorded data? then set use_sim_time and play with --clock (limit %.2f s)",
        age_sec / 86400.0, limits_.max_age_sec);
  if (age_sec > limits_.max_age_sec)
    return formatted("stamp is %.2f s old, limit %.2f s", age_sec, limits_.max_age_sec);
  if (now_sec <= 0.0 && -age_sec > limits_.max_future_sec)
    return "the clock has not begun: nothing has come on /clock yet";
  if (-age_sec > 86400.0)
    return formatted(
        "stamp is %.0f days ahead of the clock; is use_sim_time set beside a real source? (limit %.2f s)",
        -age_sec / 86400.0, limits_.max_future_sec);
  if (-age_sec > limits_.max_future_sec)
    return formatted("stamp is %.2f s ahead of the clock, limit %.2f s", -age_sec, limits_.max_future_sec) +
           (ros::Time::isSimTime() ? kSlowPlayer : "");
  if (clock_.jumpedBack(now_sec)) last_sec_.reset();
  if (last_sec_ && *sec <= *last_sec_)
    return formatted("stamp %.3f is not after the previous one, %.3f", *sec, *last_sec_);
  last_sec_ = sec;
  return std::nullopt;
}

}  // namespace window_ingress::adapters
