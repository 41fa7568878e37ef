#pragma once

#include <std_msgs/ColorRGBA.h>

#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::adapters {

/// \param rgb 0xRRGGBB
std_msgs::ColorRGBA colourOf(int rgb, double alpha = 1.0);

/// A state of the navigator: the colours of plot_flight (tools/ingress_tools/flight_data.py).
std_msgs::ColorRGBA colourOf(navigation::State state, double alpha = 1.0);

constexpr int kTrustedRgb = 0x2ecc40;   ///< the window, its normal being certain
constexpr int kOpenRgb = 0xffa500;      ///< the likelier of two windows that the images do not tell apart
constexpr int kMirroredRgb = 0xb05cff;  ///< the other one
constexpr int kWallRgb = 0xd8c8ab;      ///< the wall's plane
constexpr int kSetpointRgb = 0xff3fa4;  ///< what the navigator wishes
constexpr int kKnownRgb = 0x7fb2e5;     ///< a window that is remembered; open or closed is not known
constexpr int kClosedRgb = 0xe74c3c;    ///< one that was seen to be closed
constexpr int kTextRgb = 0xffffff;

}  // namespace window_ingress::adapters
