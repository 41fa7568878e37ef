#include "estimation/checks/frames_check.hpp"

#include <vector>

namespace window_ingress::estimation {
FramesCheck::FramesCheck(const PoseParams& pose, const FilterParams& filter, const SizeEstimate& size)
    : mounting_(pose, filter, size) {}

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
