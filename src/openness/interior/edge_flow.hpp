#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "window_ingress/openness/opening_cells.hpp"

namespace window_ingress::openness {

/// A point on an edge: its place is known across the edge alone.
struct EdgePoint {
  cv::Point2f place, normal;  ///< the normal has length 1 and points to the brighter side
};

/// Slopes of a grey image.
class SlopeImage {
 public:
  void take(const cv::Mat& grey);                                                   ///< CV_8UC1
  int steeperThan(double slope) const { return cv::countNonZero(slope_ > slope); }  ///< pixels
  /// \param mask receives 255 where the slope is less, else 0
  void flatterThan(double slope, cv::Mat& mask) const { cv::compare(slope_, slope, mask, cv::CMP_LT); }
  /// The steepest point in each block of `spacing_px` that is at least so steep; the steepest first.
  /// \param inner where to look
  std::vector<EdgePoint> steepest(const cv::Rect& inner, int spacing_px, double least_slope,
                                  std::size_t most) const;

 private:
  cv::Mat dx_, dy_, slope_;
};

/// Where the edge is in `now`, across itself (Lucas-Kanade in one dimension). Nothing if it is not found or
/// does not look the same.
std::optional<cv::Point2f> followAcross(const cv::Mat& key, const cv::Mat& now, const EdgePoint& edge,
                                        const cv::Point2f& guess);

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
