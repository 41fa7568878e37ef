#include "window_ingress/pose/frames_check.hpp"

#include <algorithm>
#include <stdexcept>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::pose {
namespace {

FramesParams checked(const FramesParams& params) {
  const auto faults = parameters::outOfRange(params);
  if (!faults.empty()) throw std::invalid_argument("frames check: " + parameters::joined(faults));
  return params;
}

}  // namespace

FramesCheck::FramesCheck(const PoseParams& pose, const FilterParams& filter, const FramesParams& params,
                         const SizeBelief& size)
    : twist_(checked(params)), mounting_(pose, filter, params, size) {}

FramesVerdict FramesCheck::verdict() const {
  const FramesVerdict mounting = mounting_.verdict(), twist = twist_.verdict();
  const auto both = {mounting.state, twist.state};
  FramesVerdict out;
  out.state = std::count(both.begin(), both.end(), FramesVerdict::kWrong) > 0  ? FramesVerdict::kWrong
              : std::count(both.begin(), both.end(), FramesVerdict::kGood) > 1 ? FramesVerdict::kGood
                                                                               : FramesVerdict::kOpen;
  for (const FramesVerdict& part : {mounting, twist})
    if (part.state == out.state) out.what += (out.what.empty() ? "" : "; ") + part.what;
  return out;
}

void FramesCheck::clear() {
  twist_.clear();
  mounting_.clear();
}

void FramesCheck::forgetPlaces() {
  twist_.startPiece();
  mounting_.forgetPlaces();
}

}  // namespace window_ingress::pose
