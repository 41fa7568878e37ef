#include "estimation/checks/frames_check.hpp"

#include <stdexcept>
#include <vector>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::estimation {
namespace {

FramesParams checked(const FramesParams& params) {
  const auto faults = parameters::outOfRange(params);
  if (!faults.empty()) throw std::invalid_argument("frames check: " + parameters::joined(faults));
  return params;
}

}  // namespace

FramesCheck::FramesCheck(const PoseParams& pose, const FilterParams& filter, const FramesParams& params,
                         const SizeEstimate& size)
    : twist_(checked(params)), attitude_(params), mounting_(pose, filter, params, size) {}

FramesVerdict FramesCheck::verdict() const {
  const FramesVerdict mounting = mounting_.verdict(), twist = twist_.verdict(),
                      attitude = attitude_.verdict();
  const auto are = [&](FramesVerdict::State state) {
    return (mounting.state == state) + (twist.state == state);
  };
  const bool wrong = are(FramesVerdict::kWrong) > 0 || attitude.state == FramesVerdict::kWrong;
  FramesVerdict out;
  out.state = wrong                            ? FramesVerdict::kWrong
              : are(FramesVerdict::kGood) == 2 ? FramesVerdict::kGood
                                               : FramesVerdict::kOpen;
  for (const FramesVerdict& part :
       wrong ? std::vector{mounting, attitude, twist} : std::vector{mounting, twist})
    if (part.state == out.state) out.what += (out.what.empty() ? "" : "; ") + part.what;
  return out;
}

void FramesCheck::clear() {
  twist_.clear();
  attitude_.clear();
  mounting_.clear();
}

void FramesCheck::forgetPlaces() {
  twist_.startPiece();
  mounting_.forgetPlaces();
}

}  // namespace window_ingress::estimation
