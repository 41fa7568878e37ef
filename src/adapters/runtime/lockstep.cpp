#include "adapters/runtime/lockstep.hpp"

#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kLinkPeriodSec = 0.02;  // connections to other nodes come up without a message

}  // namespace

Lockstep::Lockstep(ros::NodeHandle& nh, Diagnostics& diagnostics, std::function<bool(const Step&)> complete,
                   std::function<void(const Step&)> work)
    : complete_(std::move(complete)), work_(std::move(work)) {
  if (!ros::Time::isSimTime())
    throw InputError("lockstep is for simulated time only, and use_sim_time is not set");
  subscriber_ = subscribeCatching<Step>(nh, "lockstep", 10, diagnostics, [this](const auto& message) {
    pending_ = message;
    check();
  });
  timer_ = createCatchingTimer(nh, kLinkPeriodSec, "lockstep", diagnostics, [this] { check(); });
}

void Lockstep::check() {
  if (!pending_ || !complete_(*pending_)) return;
  const boost::shared_ptr<const Step> step = pending_;
  pending_.reset();
  work_(*step);
}

StampLimits limitsFor(bool lockstep, const StampLimits& limits) {
  constexpr double kAnySec = 1e9;  // a node's clock reads zero before its first message
  return lockstep ? StampLimits{60.0, kAnySec} : limits;
}

}  // namespace window_ingress::adapters
