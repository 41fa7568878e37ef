#pragma once

#include <opencv2/core.hpp>

#include "window_ingress/detection/candidate.hpp"

namespace window_ingress::detection {

struct WindowScoreParams {
  double support_low = 0.4;       ///< support of a side that counts nothing
  double overshoot_weight = 1.0;  ///< exponent of the part that sides end at their corners
  double area_full = 0.06;    ///< area from which size makes no difference to the rank, in areas of the image
  double area_weight = 0.45;  ///< exponent of the area's part in the rank
  double closure_weight = 0.5;    ///< exponent of the closure's part
  double geometry_weight = 0.25;  ///< exponent of all of the above where there is a reference to compare with
  double worth_weight = 0.7;      ///< exponent of the worth of its borders, beside the reference's

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("support_low", self.support_low, 0.0, 0.99);
    field("overshoot_weight", self.overshoot_weight, 0.0, 4.0);
    field("area_full", self.area_full, 1e-4, 1.0);
    field("area_weight", self.area_weight, 0.0, 4.0);
    field("closure_weight", self.closure_weight, 0.0, 4.0);
    field("geometry_weight", self.geometry_weight, 0.0, 4.0);
    field("worth_weight", self.worth_weight, 0.0, 4.0);
  }
};

/// How much a candidate is like a window, by geometry alone: 0 (barely a quadrilateral) to 1. Product of the
/// support of its sides, the weakest counting most, and how well they end at their corners. It does not
/// depend on its size.
double windowScore(const Candidate& candidate, const WindowScoreParams& params);

/// The same where the borders of the reference were looked for: what they look like counts most.
/// \param worth of its borders, see ReferenceBorders
double scoreWithReference(double geometry, double worth, const WindowScoreParams& params);

/// Factor by which a larger candidate is preferred to a smaller one, up to 1.
double sizeRank(const geometry::Quadrilateral& quad, const cv::Size& image, const WindowScoreParams& params);

}  // namespace window_ingress::detection
