/// A build that takes NaN and infinity for impossible ends here: every safety check rests on isfinite().
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0)
#error "window_ingress must not be built with -ffast-math or -ffinite-math-only: isfinite(NaN) would be true"
#endif
