#include "openness/interior/smooth_regions.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "window_ingress/openness/opening_cells.hpp"

namespace window_ingress::openness {
namespace {

constexpr int kSide = OpeningCells::kSide;
constexpr int kShrink = 2;        // of the image: faint edges part regions, noise does not
constexpr int kReach_px = 8;      // of a point to the regions beside its edge
constexpr double kFilled = 0.75;  // of a cell's pixels
constexpr double kDarkest = 16.0, kBrightest = 244.0;  // mean of a region in which an edge would be seen

}  // namespace

void SmoothRegions::find(const cv::Mat& grey, double most_slope) {
  cv::pyrDown(grey, small_);
  cv::GaussianBlur(small_, small_, {3, 3}, 0.0);
  slopes_.take(small_);
  slopes_.flatterThan(kShrink * most_slope, is_smooth_);
  cv::erode(is_smooth_, is_smooth_, cv::Mat());  // closes gaps of up to two of its pixels in edges
  fillCells(cv::connectedComponents(is_smooth_, labels_, 4, CV_32S));
}

void SmoothRegions::fillCells(int regions) {
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

std::uint64_t SmoothRegions::cellsBeside(const cv::Point2f& point) const {
  const int x = static_cast<int>(std::lround(point.x / kShrink));
  const int y = static_cast<int>(std::lround(point.y / kShrink));
  constexpr int kReach = kReach_px / kShrink;
  std::uint64_t beside = 0;
  for (int row = std::max(0, y - kReach); row <= std::min(labels_.rows - 1, y + kReach); ++row)
    for (int column = std::max(0, x - kReach); column <= std::min(labels_.cols - 1, x + kReach); ++column)
      beside |= cells_of_[static_cast<std::size_t>(labels_.at<int>(row, column))];
  return beside;
}

}  // namespace window_ingress::openness
