#pragma once

#include <string>

namespace window_ingress::openness {

enum class Openness {
  kUnknown,  ///< not enough seen, or it contradicts itself
  kOpen,     ///< what is seen within the border lies well behind it
  kClosed    ///< it lies in the border's plane, or next to it
};

const char* toString(Openness openness);  ///< UNKNOWN, OPEN, CLOSED

/// Whether the opening is one, as far as parallax has shown. One camera cannot tell a mirror's depth from a
/// room's.
struct OpennessVerdict {
  Openness openness = Openness::kUnknown;
  double log_odds = 0.0;        ///< open over closed, natural logarithm
  bool has_depth = false;       ///< false: the two below are zero and invalid
  double depth_behind_m = 0.0;  ///< of what is seen, behind the plane of the border, median [m]
  double depth_sigma_m = 0.0;   ///< standard deviation of that depth [m]
  double open_share = 0.0;  ///< of the middle that the vehicle needs: how much was seen to be open, 0 to 1
  int points = 0;           ///< that the newest stretch rests on
  int stretches = 0;        ///< of the flight that have spoken, each for itself
  std::string reason = "no texture followed within the opening so far";  ///< for people, with numbers
};

}  // namespace window_ingress::openness
