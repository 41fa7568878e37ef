#pragma once

#include <string>

namespace window_ingress::geometry {

/// The relative yaw for people, in degrees: "yaw +12.3 +-0.4 deg", with "sign unknown" after it where it is.
/// Spreads beyond a half turn say no more than that; they are cut there.
std::string yawText(double yaw_rad, double sigma_rad, bool sign_trusted);

}  // namespace window_ingress::geometry
