#pragma once

namespace window_ingress::detection {

/// A line near an axis: offset from it at a position along it.
struct OffsetLine {
  double offset = 0.0;  ///< at position 0 [px]
  double slope = 0.0;   ///< [px per px]
  double at(double position) const { return offset + slope * position; }
};

/// Points near an axis, in the caller's memory.
struct OffsetPoints {
  const double* positions;
  const double* offsets;
  double* scratch;  ///< room for two numbers per point
  int count;
};

/// Fits the line to points near it: reweighted least squares with Tukey's bisquare. Points further off than
/// three times `scale_px` do not count in the end. With fewer than two points the line does not change.
void fitRobustLine(const OffsetPoints& points, double scale_px, OffsetLine& line);

}  // namespace window_ingress::detection
