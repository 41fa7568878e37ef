/// Stops a build that assumes finite math: every safety check relies on isfinite().
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0)
#error "window_ingress must not be built with -ffast-math or -ffinite-math-only: isfinite(NaN) would be true"
#endif
