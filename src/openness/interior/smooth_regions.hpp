#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "openness/interior/edge_klt.hpp"

namespace window_ingress::openness {

/// Regions of the straightened opening in which no edge is seen. An edge belongs to the nearer of the two
/// surfaces that it parts, so the regions on both its sides are as deep as the edge, and so is all of them:
/// the bare wall beside a cupboard is seen through all of the opening that it fills. This does not hold where
/// two surfaces look so alike that no edge is seen between them; so regions that are too dark or too bright
/// to show one are none.
class SmoothRegions {
 public:
  /// \param grey CV_8UC1, the straightened opening
  /// \param most_slope that noise and shading have [grey levels a pixel]
  void find(const cv::Mat& grey, double most_slope);
  /// Cells of `OpeningCells` that regions fill which end at this point, one bit each, row by row.
  std::uint64_t cellsBeside(const cv::Point2f& point) const;

 private:
  void fillCells(int regions);

  SlopeImage slopes_;
  cv::Mat small_, is_smooth_, labels_;  // half as wide and high
  std::vector<double> brightness_;      // by label: sum of it, and pixels, and those in one cell
  std::vector<int> pixels_, within_;
  std::vector<std::uint64_t> cells_of_;  // by label; those that it fills
};

}  // namespace window_ingress::openness
