#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "openness/interior/edge_klt.hpp"
#include "window_ingress/openness/opening_cells.hpp"

namespace window_ingress::openness {

/// Regions of the rectified opening without a visible edge. An edge belongs to the nearer of the two
/// surfaces that it separates, so the regions on both its sides are as deep as the edge, over their whole
/// extent. The bare wall beside a cupboard, for example, is seen through the whole part of the opening that
/// it fills. This does not hold where two surfaces look so alike that no edge is visible between them. So
/// regions too dark or too bright to show an edge do not count.
class SmoothRegions {
 public:
  /// \param grey CV_8UC1, the rectified opening
  /// \param most_slope largest slope of noise and shading [grey levels per pixel]
  void find(const cv::Mat& grey, double most_slope) {
    cv::pyrDown(grey, small_);
    cv::GaussianBlur(small_, small_, {3, 3}, 0.0);
    slopes_.take(small_);
    slopes_.flatterThan(kShrink * most_slope, is_smooth_);
    cv::erode(is_smooth_, is_smooth_, cv::Mat());  // closes gaps in edges of up to two of its pixels
    fillCells(cv::connectedComponents(is_smooth_, labels_, 4, CV_32S));
  }

  /// Cells of `OpeningCells` filled by regions that end at this point, one bit each, row by row.
  std::uint64_t cellsBeside(const cv::Point2f& point) const {
    const int x = static_cast<int>(std::lround(point.x / kShrink));
    const int y = static_cast<int>(std::lround(point.y / kShrink));
    constexpr int kReach = kReach_px / kShrink;
    std::uint64_t beside = 0;
    for (int row = std::max(0, y - kReach); row <= std::min(labels_.rows - 1, y + kReach); ++row)
      for (int column = std::max(0, x - kReach); column <= std::min(labels_.cols - 1, x + kReach); ++column)
        beside |= cells_of_[static_cast<std::size_t>(labels_.at<int>(row, column))];
    return beside;
  }

 private:
  static constexpr int kSide = OpeningCells::kSide;
  static constexpr int kShrink = 2;        // reduction: faint edges separate regions, noise does not
  static constexpr int kReach_px = 8;      // from a point to the regions beside its edge
  static constexpr double kFilled = 0.75;  // of a cell's pixels
  static constexpr double kDarkest = 16.0,
                          kBrightest = 244.0;  // mean of a region in which an edge would be visible

  void fillCells(int regions) {
    brightness_.assign(static_cast<std::size_t>(regions), 0.0);
    pixels_.assign(static_cast<std::size_t>(regions), 0);
    for (int y = 0; y < small_.rows; ++y)
      for (int x = 0; x < small_.cols; ++x) {
        const auto label = static_cast<std::size_t>(labels_.at<int>(y, x));
        brightness_[label] += small_.at<unsigned char>(y, x);
        ++pixels_[label];
      }
    cells_of_.assign(static_cast<std::size_t>(regions), 0);
    for (int row = 0; row < kSide; ++row)
      for (int column = 0; column < kSide; ++column) {
        const int left = column * small_.cols / kSide, right = (column + 1) * small_.cols / kSide;
        const int top = row * small_.rows / kSide, bottom = (row + 1) * small_.rows / kSide;
        within_.assign(static_cast<std::size_t>(regions), 0);
        for (int y = top; y < bottom; ++y)
          for (int x = left; x < right; ++x) ++within_[static_cast<std::size_t>(labels_.at<int>(y, x))];
        within_[0] = 0;  // edges
        const auto most = std::max_element(within_.begin(), within_.end());
        const auto label = static_cast<std::size_t>(most - within_.begin());
        const double mean = brightness_[label] / std::max(1, pixels_[label]);
        if (*most > kFilled * (right - left) * (bottom - top) && mean > kDarkest && mean < kBrightest)
          cells_of_[label] |= std::uint64_t{1} << (row * kSide + column);
      }
  }

  SlopeImage slopes_;
  cv::Mat small_, is_smooth_, labels_;  // half as wide and high
  std::vector<double> brightness_;      // by label: sum, pixels, pixels in one cell
  std::vector<int> pixels_, within_;
  std::vector<std::uint64_t> cells_of_;  // by label: cells that it fills
};

}  // namespace window_ingress::openness
