#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/detection/candidate.hpp"

namespace window_ingress::detection {

struct CandidateGatesParams {
  double min_area = 0.003;      ///< of the quadrilateral, in areas of the image (the farthest window)
  double max_area = 0.90;       ///< of the quadrilateral, in areas of the image (the nearest window)
  double min_aspect = 0.2;      ///< width over height, as seen
  double max_aspect = 3.5;      ///< width over height, as seen
  double min_solidity = 0.8;    ///< area of the outline over area of its hull
  double max_angle_rad = 0.85;  ///< of a corner away from 90 degrees (the largest yaw) [rad]
  double border = 0.003;  ///< a corner this close to the image's border is cut, in longer sides of the image
  double min_side_support = 0.45;  ///< of the weakest side: part that runs along straight edges
  double mean_side_support = 0.7;  ///< of the four sides together
  double min_contrast = 2.0;       ///< gradient of the weakest side [grey levels a pixel]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("min_area", self.min_area, 0.0, 1.0);
    field("max_area", self.max_area, 0.0, 1.0);
    field("min_aspect", self.min_aspect, 0.01, 1.0);
    field("max_aspect", self.max_aspect, 1.0, 100.0);
    field("min_solidity", self.min_solidity, 0.0, 1.0);
    field("max_angle_rad", self.max_angle_rad, 0.0, 1.5);
    field("border", self.border, 0.0, 0.2);
    field("min_side_support", self.min_side_support, 0.0, 1.0);
    field("mean_side_support", self.mean_side_support, 0.0, 1.0);
    field("min_contrast", self.min_contrast, 0.0, 255.0);
  }
};

/// Why a candidate was stopped, and by how much.
struct Rejection {
  RejectReason reason = RejectReason::kNone;
  double value = 0.0;
  double limit = 0.0;
};

/// The paper's conditions on a candidate (P8), each a gate with a name.
class CandidateGates {
 public:
  explicit CandidateGates(const CandidateGatesParams& params) : params_(params) {}

  /// Gates on the shape alone: corners, area, aspect ratio, solidity, angles, border.
  std::optional<Rejection> shape(const Candidate& candidate, const cv::Size& image) const;

  /// Gates on what the edge map says of its sides: line support, contrast.
  std::optional<Rejection> support(const Candidate& candidate) const;

 private:
  CandidateGatesParams params_;
};

}  // namespace window_ingress::detection
