#pragma once

#include <string>

namespace window_ingress::estimation {

/// What the first metres of flight have shown about the frames.
struct FramesVerdict {
  enum State {
    kUndecided,  ///< not enough seen
    kGood,
    kWrong
  };
  State state = kUndecided;
  std::string what;  ///< names the mismatch, or what is still to be seen

  bool operator==(const FramesVerdict& other) const { return state == other.state && what == other.what; }
};

}  // namespace window_ingress::estimation
