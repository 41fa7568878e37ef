#include "detection/candidates/preprocess.hpp"

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "detection/chromaticity.hpp"
#include "detection/image_pyramid.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kColourGain = 2.0;    ///< of differences between channels in the colour-only image
constexpr int kUnpainted = 100;        ///< value of pixels without the paint, in the image of one paint
constexpr float kPaintGain = 400.0F;   ///< of chromaticities, in the image of one paint
constexpr double kPaintSigmaPx = 1.2;  ///< smoothing of the image of one paint, because dark pixels are noisy
constexpr double kClipLimit = 2.0;     ///< of the equalisation [mean bin counts]
constexpr int kTiles = 6;              ///< of the equalisation, in each direction

constexpr double kSigmaPx = 1.0;         ///< of the smoothing: differences between channels are noisy
constexpr double kMeanOver = 1.0 / 3.0;  ///< side of the averaging square [longer level sides]
constexpr int kMinSidePx = 16;           ///< of a level; narrow strips are not reduced below this

}  // namespace

SearchLevel Preprocess::run(const cv::Mat& image) {
  SearchLevel level;
  cv::Mat current = image;
  for (int i = 0; std::max(current.cols, current.rows) > params_.search_side_px; i ^= 1) {
    if (std::min(current.cols, current.rows) / 2 < kMinSidePx) break;
    halve(current, levels_[i]);
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

const cv::Mat& Preprocess::coloursAlone() {
  colours_.release();
  if (smooth_.channels() != 3) return colours_;
  const float half = static_cast<float>(0.5 * kColourGain), middle = 128.0F;
  const cv::Matx34f differences(0.0F, -half, half, middle,                 //
                                half, -0.5F * half, -0.5F * half, middle,  //
                                -half, 0.0F, half, middle);
  cv::transform(smooth_, colours_, differences);
  return colours_;
}

const cv::Mat& Preprocess::paintAlone(const Eigen::Vector3f& paint) {
  if (smooth_.channels() != 3) {
    colours_.release();
    return colours_;
  }
  colours_.create(smooth_.size(), CV_8UC1);
  for (int y = 0; y < smooth_.rows; ++y) {
    const auto* pixels = smooth_.ptr<cv::Vec3b>(y);
    auto* painted = colours_.ptr<std::uint8_t>(y);
    for (int x = 0; x < smooth_.cols; ++x) {
      const Eigen::Vector3f pixel(pixels[x][0], pixels[x][1], pixels[x][2]);
      painted[x] = cv::saturate_cast<std::uint8_t>(kUnpainted + kPaintGain * paint.dot(chromaticity(pixel)));
    }
  }
  cv::GaussianBlur(colours_, colours_, cv::Size(), kPaintSigmaPx, kPaintSigmaPx, cv::BORDER_REPLICATE);
  return colours_;
}

void Preprocess::equalise(cv::Mat& image) {
  const auto clahe = cv::createCLAHE(kClipLimit, cv::Size(kTiles, kTiles));
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

void BlobMasks::take(const cv::Mat& level, int channel) {
  cv::extractChannel(level, channel_, channel);
  cv::GaussianBlur(channel_, channel_, cv::Size(), kSigmaPx, kSigmaPx, cv::BORDER_REPLICATE);
  const int side = static_cast<int>(kMeanOver * std::max(level.cols, level.rows)) | 1;
  cv::boxFilter(channel_, mean_, -1, cv::Size(side, side));
}

const cv::Mat& BlobMasks::run(Sign sign, double contrast) {
  if (sign == Sign::kAbove)
    cv::subtract(channel_, mean_, difference_);
  else
    cv::subtract(mean_, channel_, difference_);
  cv::compare(difference_, contrast, mask_, cv::CMP_GT);
  return mask_;
}

}  // namespace window_ingress::detection
