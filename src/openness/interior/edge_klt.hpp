#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace window_ingress::openness {

/// A point on an edge; its position is known only across the edge.
struct EdgePoint {
  cv::Point2f place, normal;  ///< the normal has length 1 and points to the brighter side
  float slope = 0.0f;         ///< [grey levels per pixel]
};

/// Slopes of a grey image.
class SlopeImage {
 public:
  void take(const cv::Mat& grey);                                                   ///< CV_8UC1
  int steeperThan(double slope) const { return cv::countNonZero(slope_ > slope); }  ///< pixels
  /// \param mask receives 255 where the slope is less, else 0
  void flatterThan(double slope, cv::Mat& mask) const { cv::compare(slope_, slope, mask, cv::CMP_LT); }
  /// The steepest point in each block of `spacing_px` with at least `least_slope`, the steepest first.
  /// \param inner area to search
  std::vector<EdgePoint> steepest(const cv::Rect& inner, int spacing_px, double least_slope,
                                  std::size_t most) const;

 private:
  cv::Mat dx_, dy_, slope_;
};

/// Position of the edge in `now`, across the edge (Lucas-Kanade in one dimension). Nothing if it is not found
/// or looks different.
std::optional<cv::Point2f> followAcross(const cv::Mat& key, const cv::Mat& now, const EdgePoint& edge,
                                        const cv::Point2f& guess);

}  // namespace window_ingress::openness
