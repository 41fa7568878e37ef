#include "window_ingress/openness/smooth_regions.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace window_ingress::openness {
namespace {

constexpr int kSide = OpeningCells::kSide;
constexpr double kBlur_px = 2.0;  // more than what is followed: faint edges part regions, noise does not
constexpr int kReach_px = 8;      // of a point to the regions beside its edge
constexpr double kFilled = 0.75;  // of a cell's pixels
constexpr double kDarkest = 16.0, kBrightest = 244.0;  // mean of a region in which an edge would be seen

}  // namespace

void SmoothRegions::find(const cv::Mat& grey, double most_slope) {
  cv::GaussianBlur(grey, smooth_, cv::Size(), kBlur_px);
  cv::Sobel(smooth_, dx_, CV_32F, 1, 0, 3, 1.0 / 8.0);
  cv::Sobel(smooth_, dy_, CV_32F, 0, 1, 3, 1.0 / 8.0);
  cv::magnitude(dx_, dy_, slope_);
  is_smooth_ = slope_ < most_slope;
  cv::erode(is_smooth_, is_smooth_, cv::Mat());  // closes gaps of up to two pixels in edges
  fillCells(grey, cv::connectedComponents(is_smooth_, labels_, 4, CV_32S));
}

void SmoothRegions::fillCells(const cv::Mat& grey, int regions) {
  brightness_.assign(static_cast<std::size_t>(regions), 0.0);
  pixels_.assign(static_cast<std::size_t>(regions), 0);
  for (int y = 0; y < grey.rows; ++y)
    for (int x = 0; x < grey.cols; ++x) {
      const auto label = static_cast<std::size_t>(labels_.at<int>(y, x));
      brightness_[label] += grey.at<unsigned char>(y, x);
      ++pixels_[label];
    }
  cells_of_.assign(static_cast<std::size_t>(regions), 0);
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const int left = column * grey.cols / kSide, right = (column + 1) * grey.cols / kSide;
      const int top = row * grey.rows / kSide, bottom = (row + 1) * grey.rows / kSide;
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
  const int x = static_cast<int>(std::lround(point.x)), y = static_cast<int>(std::lround(point.y));
  std::uint64_t beside = 0;
  for (int row = std::max(0, y - kReach_px); row <= std::min(labels_.rows - 1, y + kReach_px); ++row)
    for (int column = std::max(0, x - kReach_px); column <= std::min(labels_.cols - 1, x + kReach_px);
         ++column)
      beside |= cells_of_[static_cast<std::size_t>(labels_.at<int>(row, column))];
  return beside;
}

}  // namespace window_ingress::openness
