#pragma once

#include <string>

namespace window_ingress::estimation {

/// What the first metres have shown of the frames.
struct FramesVerdict {
  enum State {
    kOpen,  ///< not seen enough
    kGood,
    kWrong
  };
  State state = kOpen;
  std::string what;  ///< names the mismatch, or what is still to be seen

  bool operator==(const FramesVerdict& other) const { return state == other.state && what == other.what; }
};

}  // namespace window_ingress::estimation
