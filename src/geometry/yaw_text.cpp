#include "window_ingress/geometry/yaw_text.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::geometry {

std::string yawText(double yaw_rad, double sigma_rad, bool sign_trusted) {
  if (!std::isfinite(yaw_rad) || !std::isfinite(sigma_rad)) return "yaw not finite";
  const double sigma_deg = std::clamp(sigma_rad * kDegreesPerRad, 0.0, 180.0);
  return formatted(sigma_deg < 0.095 ? "yaw %+.2f +-%.2f deg%s" : "yaw %+.1f +-%.1f deg%s",
                   yaw_rad * kDegreesPerRad, sigma_deg, sign_trusted ? "" : ", sign unknown");
}

}  // namespace window_ingress::geometry
