/// What several nodes are told.
#pragma once

#include <string>

namespace window_ingress::configuration {

/// Names of frames that a message must carry.
struct FrameNames {
  std::string odom = "odom";
  std::string base = "base_link";
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("odom_frame", self.odom);
    field("base_frame", self.base);
  }
};

/// How old and how far ahead of the clock a message may be.
struct StampLimits {
  double max_age_sec = 0.5;     ///< older messages are refused [s]
  double max_future_sec = 0.2;  ///< messages further ahead of the clock are refused [s]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_age_sec", self.max_age_sec, 0.01, 60.0);
    field("max_future_sec", self.max_future_sec, 0.0, 10.0);
  }
};

struct ImageLimits {
  int max_pixels = 8000000;  ///< larger images are refused [px]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_pixels", self.max_pixels, 1, 100000000);
  }
};

}  // namespace window_ingress::configuration
