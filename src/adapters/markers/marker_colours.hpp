/// Colours of the markers in rviz.
#pragma once

#include <std_msgs/ColorRGBA.h>

#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::adapters {

constexpr int kTrustedRgb = 0x2ecc40;   ///< the window, if its normal is trusted
constexpr int kOpenRgb = 0xffa500;      ///< the likelier of the two solutions
constexpr int kMirroredRgb = 0xb05cff;  ///< the less likely solution
constexpr int kWallRgb = 0xd8c8ab;      ///< the plane of the wall
constexpr int kKnownRgb = 0x7fb2e5;     ///< a remembered window of unknown openness
constexpr int kClosedRgb = 0xe74c3c;    ///< a closed window
constexpr int kSetpointRgb = 0xff3fa4;  ///< the navigator's setpoint
constexpr int kTextRgb = 0xffffff;

/// \param rgb 0xRRGGBB
std_msgs::ColorRGBA colourOf(int rgb, double alpha = 1.0);

/// Colour of a navigator's state, as in plot_flight (tools/ingress_tools/flight_data.py).
std_msgs::ColorRGBA colourOf(navigation::State state, double alpha = 1.0);

}  // namespace window_ingress::adapters
