#pragma once

#include <string>

namespace window_ingress::openness {

enum class Openness {
  kUnknown,  ///< not enough seen, or it contradicts itself
  kOpen,     ///< what is seen within the border lies well behind it
  kClosed    ///< what is seen within the border lies in its plane or next to it
};

const char* toString(Openness openness);  ///< UNKNOWN, OPEN, CLOSED

/// Whether the opening is open, by parallax. One camera cannot tell a mirror's depth from a room's.
struct OpennessVerdict {
  Openness openness = Openness::kUnknown;
  double log_odds = 0.0;        ///< open over closed, natural logarithm
  bool has_depth = false;       ///< false: the next two fields are zero and invalid
  double depth_behind_m = 0.0;  ///< median depth of the points behind the plane of the border [m]
  double depth_sigma_m = 0.0;   ///< standard deviation of that depth [m]
  double open_share = 0.0;      ///< part of the middle needed by the vehicle that was seen open, 0 to 1
  int points = 0;               ///< points in the newest stretch
  int stretches = 0;            ///< stretches of the flight that gave evidence
  std::string reason = "no texture followed within the opening so far";  ///< for people, with numbers
};

}  // namespace window_ingress::openness
