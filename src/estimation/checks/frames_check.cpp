#include "estimation/checks/frames_check.hpp"

#include <vector>

namespace window_ingress::estimation {

FramesVerdict FramesCheck::verdict() const {
  const FramesVerdict mounted = mounting.verdict(), twisted = twist.verdict(), tilted = attitude.verdict();
  const auto are = [&](FramesVerdict::State state) {
    return (mounted.state == state) + (twisted.state == state);
  };
  const bool wrong = are(FramesVerdict::kWrong) > 0 || tilted.state == FramesVerdict::kWrong;
  FramesVerdict out;
  out.state = wrong                            ? FramesVerdict::kWrong
              : are(FramesVerdict::kGood) == 2 ? FramesVerdict::kGood
                                               : FramesVerdict::kUndecided;
  for (const FramesVerdict& part :
       wrong ? std::vector{mounted, tilted, twisted} : std::vector{mounted, twisted})
    if (part.state == out.state) out.what += (out.what.empty() ? "" : "; ") + part.what;
  return out;
}

void FramesCheck::clear() {
  twist.clear();
  attitude.clear();
  mounting.clear();
}

void FramesCheck::forgetPlaces() {
  twist.startPiece();
  mounting.forgetPlaces();
}

}  // namespace window_ingress::estimation
