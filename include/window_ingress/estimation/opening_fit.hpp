#pragma once

#include <string>

#include "window_ingress/estimation/size_estimate.hpp"

namespace window_ingress::estimation {

/// How sure it must be that the vehicle passes.
struct FitParams {
  double margin_m = 0.05;  ///< that must be left on each side [m]
  double sigmas = 2.0;     ///< standard deviations of the size by which it must be certain

  // Of the vehicle's box, propellers included. Not in `visit`: config/vehicle.yaml says them.
  double vehicle_width_m = 0.5, vehicle_height_m = 0.24;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("margin_m", self.margin_m, 0.0, 2.0);
    field("sigmas", self.sigmas, 0.0, 10.0);
  }
};

enum class Fit {
  kUnknown,  ///< the size is not known well enough to say
  kGo,       ///< vehicle and margins fit
  kNoGo      ///< they do not
};

const char* toString(Fit fit);

struct FitVerdict {
  Fit fit = Fit::kUnknown;
  std::string reason = "no window";  ///< with numbers
};

/// GO if width and height both exceed what is needed by `sigmas` standard deviations, NO-GO if either falls
/// short of it by as much.
FitVerdict fitVerdict(const SizeEstimate& opening, const FitParams& params);

}  // namespace window_ingress::estimation
