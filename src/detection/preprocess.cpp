#include "window_ingress/detection/preprocess.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace window_ingress::detection {

SearchLevel Preprocess::run(const cv::Mat& image) {
  SearchLevel level;
  cv::Mat current = image;
  for (int i = 0; std::max(current.cols, current.rows) > params_.search_side_px; i ^= 1) {
    const cv::Size half(current.cols / 2, current.rows / 2);
    cv::resize(current(cv::Rect(0, 0, 2 * half.width, 2 * half.height)), levels_[i], half, 0, 0,
               cv::INTER_AREA);
    current = levels_[i];
    level.factor *= 2;
  }
  if (params_.blur_sigma_px > 0.0)
    cv::GaussianBlur(current, smooth_, cv::Size(), params_.blur_sigma_px, params_.blur_sigma_px,
                     cv::BORDER_REPLICATE);
  else
    current.copyTo(smooth_);
  if (params_.equalise) equalise(smooth_);
  level.image = smooth_;
  return level;
}

void Preprocess::equalise(cv::Mat& image) {
  const auto clahe = cv::createCLAHE(params_.clip_limit, cv::Size(params_.tiles, params_.tiles));
  if (image.channels() == 1) {
    clahe->apply(image, image);
    return;
  }
  cv::cvtColor(image, lab_, cv::COLOR_BGR2Lab);
  cv::Mat lightness;
  cv::extractChannel(lab_, lightness, 0);
  clahe->apply(lightness, lightness);
  cv::insertChannel(lightness, lab_, 0);
  cv::cvtColor(lab_, image, cv::COLOR_Lab2BGR);
}

}  // namespace window_ingress::detection
