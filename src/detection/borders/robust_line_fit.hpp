#pragma once

namespace window_ingress::detection {

/// A line near an axis: offset from it at a position along it.
struct OffsetLine {
  double offset = 0.0;  ///< at position 0 [px]
  double slope = 0.0;   ///< [px a px]
  double at(double position) const { return offset + slope * position; }
};

/// Points near an axis, in the caller's memory.
struct OffsetPoints {
  const double* positions;
  const double* offsets;
  double* scratch;  ///< room for two numbers a point
  int count;
};

/// Moves the line onto the points, starting near it: reweighted least squares with Tukey's bisquare, so that
/// points further off than three times `scale_px` do not count in the end. Fewer than two points leave it as
/// it is.
void fitRobustLine(const OffsetPoints& points, double scale_px, OffsetLine& line);

}  // namespace window_ingress::detection
