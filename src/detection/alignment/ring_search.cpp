#include "detection/alignment/ring_search.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "detection/quads.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kSidePx = 14.0;                          ///< of the pattern [px a mean side]
constexpr double kSmallestPx = 40.0, kLargestPart = 0.8;  ///< mean side [px; of the shorter image side]
constexpr double kStep = 1.3;                             ///< from one size to the next
constexpr float kLeast = 0.25F;                           ///< correlation of a place
constexpr float kLogNoise = 0.02F;                        ///< of a logarithm of a colour
constexpr int kPeakPx = 5;

// Logarithms of all colours, each difference with its weight.
void logsOf(const RingModel& model, const cv::Mat& image, cv::Mat& logs) {
  logs.create(image.size(), CV_32FC(image.channels()));
  const int channels = image.channels();
  for (int row = 0; row < image.rows; ++row) {
    const uchar* from = image.ptr(row);
    auto* to = logs.ptr<float>(row);
    for (int i = 0; i < image.cols * channels; ++i) to[i] = kLogsOfColours[from[i]];
    if (channels == 3)
      for (int i = 0; i < 3 * image.cols; i += 3) model.weighColour(to[i], to[i + 1], to[i + 2]);
  }
}

}  // namespace

void RingSearch::learn(const RingModel& model) {
  forget();
  if (!model.known()) return;
  const RingLevel& ring = model.level(kSidePx);
  const int channels = model.channels(), count = ring.size();
  opening_ = cv::Size2d(ring.side_px * ring.width, ring.side_px * ring.height);
  double reach_x = 0.0, reach_y = 0.0;
  for (int i = 0; i < count; ++i) {
    reach_x = std::max(reach_x, std::abs(ring.x[i]) * opening_.width);
    reach_y = std::max(reach_y, std::abs(ring.y[i]) * opening_.height);
  }
  const cv::Size size(2 * static_cast<int>(std::lround(reach_x + 0.5)),
                      2 * static_cast<int>(std::lround(reach_y + 0.5)));
  pattern_ = cv::Mat::zeros(size, CV_32FC(channels));
  mask_ = cv::Mat::zeros(size, CV_32F);
  count_ = count, norm_ = 0.0;
  for (int c = 0; c < channels; ++c) {
    const float* values = ring.values.data() + static_cast<std::size_t>(c) * count;
    double mean = 0.0;
    for (int i = 0; i < count; ++i) mean += values[i] / count;
    for (int i = 0; i < count; ++i) {
      const int column = static_cast<int>(std::floor(ring.x[i] * opening_.width + 0.5 * size.width));
      const int row = static_cast<int>(std::floor(ring.y[i] * opening_.height + 0.5 * size.height));
      const auto value = static_cast<float>(values[i] - mean);
      pattern_.ptr<float>(row)[column * channels + c] = value;
      mask_.at<float>(row, column) = 1.0F;
      norm_ += value * value;
    }
  }
}

// Of the image of this scale with the pattern, at every place.
bool RingSearch::correlate(const RingModel& model, double factor) {
  const int k = std::max(0, static_cast<int>(std::floor(-std::log2(factor))));
  const cv::Mat& from = pyramid_.level(k);
  const cv::Size full = pyramid_.level(0).size();
  const cv::Size size(static_cast<int>(full.width * factor), static_cast<int>(full.height * factor));
  if (size.width < pattern_.cols || size.height < pattern_.rows) return false;
  cv::resize(from, level_, size, 0, 0, cv::INTER_AREA);
  logsOf(model, level_, logs_);
  cv::matchTemplate(logs_, pattern_, alike_, cv::TM_CCORR);
  cv::split(logs_, channels_);
  squares_ = cv::Mat::zeros(size, CV_32F);
  for (const cv::Mat& channel : channels_) cv::accumulateSquare(channel, squares_);
  cv::matchTemplate(squares_, mask_, variance_, cv::TM_CCORR);
  for (const cv::Mat& channel : channels_) {
    cv::matchTemplate(channel, mask_, sum_, cv::TM_CCORR);
    variance_ -= sum_.mul(sum_, 1.0 / count_);
  }
  const auto noise =
      static_cast<float>(kLogNoise * kLogNoise * count_ * static_cast<double>(channels_.size()));
  variance_ = cv::max(variance_, 0.0F) + noise;
  cv::sqrt(variance_, variance_);
  cv::divide(alike_, variance_, alike_, 1.0 / std::sqrt(norm_ + noise));
  return true;
}

void RingSearch::takePeaks(double factor) {
  cv::dilate(alike_, peaks_, cv::Mat::ones(kPeakPx, kPeakPx, CV_8U));
  const double x0 = 0.5 * (pattern_.cols - opening_.width), y0 = 0.5 * (pattern_.rows - opening_.height);
  const auto in_image = [factor](double x, double y) {
    return Eigen::Vector2d(x / factor - 0.5, y / factor - 0.5);
  };
  for (int row = 0; row < alike_.rows; ++row)
    for (int column = 0; column < alike_.cols; ++column) {
      const float value = alike_.at<float>(row, column);
      if (value < kLeast || value < peaks_.at<float>(row, column)) continue;
      const double left = column + x0, top = row + y0, right = left + opening_.width,
                   bottom = top + opening_.height;
      places_.push_back(
          {{in_image(left, top), in_image(right, top), in_image(right, bottom), in_image(left, bottom)},
           value});
    }
}

const std::vector<RingSearch::Place>& RingSearch::run(const RingModel& model, const cv::Mat& image,
                                                      std::size_t most) {
  places_.clear();
  if (!known()) return places_;
  pyramid_.set(image);
  const double largest = kLargestPart * std::min(image.cols, image.rows);
  for (double side_px = kSmallestPx; side_px < largest; side_px *= kStep)
    if (const double factor = kSidePx / side_px; correlate(model, factor)) takePeaks(factor);
  std::stable_sort(places_.begin(), places_.end(),
                   [](const Place& a, const Place& b) { return a.correlation > b.correlation; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < places_.size() && kept < most; ++i) {
    const auto end = places_.begin() + static_cast<std::ptrdiff_t>(kept);
    if (std::none_of(places_.begin(), end,
                     [&](const Place& p) { return Sameness(p.quad).samePlace(places_[i].quad); }))
      places_[kept++] = places_[i];
  }
  places_.resize(kept);
  return places_;
}

}  // namespace window_ingress::detection
