#include "window_ingress/estimation/target_motion.hpp"

namespace window_ingress::estimation {

MotionModel::While MotionModel::over(double elapsed_sec) const {
  While out;
  if (stands() || !(elapsed_sec > 0.0)) return out;
  const double spans = elapsed_sec / time_sec, variance = speed_mps * speed_mps;
  const double lost = -std::expm1(-spans);  // exact for short times, too
  out.kept = 1.0 - lost;
  out.way_sec = time_sec * lost;
  out.velocity_variance = variance * lost * (1.0 + out.kept);
  out.cross_covariance = variance * time_sec * lost * lost;
  // The closed form cancels for short times; there the leading term of its series is used.
  const double series =
      spans < 1e-3 ? 2.0 / 3.0 * spans * spans * spans : 2.0 * spans - 2.0 * lost - lost * lost;
  out.place_variance = variance * time_sec * time_sec * series;
  return out;
}

}  // namespace window_ingress::estimation
