#pragma once

#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::configuration {

using navigation::FrameNames;
using navigation::StampLimits;

/// Limits of input images.
struct ImageLimits {
  int max_pixels = 8000000;  ///< images with more pixels are refused [px]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_pixels", self.max_pixels, 1, 100000000);
  }
};

}  // namespace window_ingress::configuration
