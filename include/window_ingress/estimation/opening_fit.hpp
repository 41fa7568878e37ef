#pragma once

#include <string>

#include "window_ingress/estimation/size_estimate.hpp"

namespace window_ingress::estimation {

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

/// GO if width and height both certainly exceed what the vehicle needs, margins included, NO-GO if either
/// certainly falls short of it.
FitVerdict fitVerdict(const SizeEstimate& opening, const geometry::OpeningSize& needed);

}  // namespace window_ingress::estimation
