#include "detection/candidates/preprocess.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <utility>

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

void equalise(cv::Mat& image) {
  const auto clahe = cv::createCLAHE(kClipLimit, cv::Size(kTiles, kTiles));
  if (image.channels() == 1) return clahe->apply(image, image);
  cv::Mat lab, lightness;
  cv::cvtColor(image, lab, cv::COLOR_BGR2Lab);
  cv::extractChannel(lab, lightness, 0);
  clahe->apply(lightness, lightness);
  cv::insertChannel(lightness, lab, 0);
  cv::cvtColor(lab, image, cv::COLOR_Lab2BGR);
}

}  // namespace

std::optional<geometry::PinholeCamera> lensOfLevel(const geometry::PinholeCamera* camera,
                                                   const SearchLevel& level) {
  if (!geometry::lensOf(camera)) return std::nullopt;
  geometry::PinholeCamera lens = *camera;
  const double factor = level.factor, shift = 0.5 * (factor - 1.0);
  lens.width = level.image.cols, lens.height = level.image.rows;
  lens.fx /= factor, lens.fy /= factor;
  lens.cx = (lens.cx - shift) / factor, lens.cy = (lens.cy - shift) / factor;
  return lens;
}

SearchLevel preprocess(const cv::Mat& image, const PreprocessParams& params, cv::Mat smooth) {
  thread_local std::array<cv::Mat, 2> halves;
  SearchLevel level{image, 1};
  while (std::max(level.image.cols, level.image.rows) > params.search_side_px &&
         std::min(level.image.cols, level.image.rows) / 2 >= kMinSidePx) {
    halve(level.image, halves[0]);
    level = {halves[0], 2 * level.factor};
    std::swap(halves[0], halves[1]);
  }
  const double sigma_px = params.blur_sigma_px;
  if (sigma_px > 0.0)
    cv::GaussianBlur(level.image, smooth, cv::Size(), sigma_px, sigma_px,
                     cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  else
    level.image.copyTo(smooth);
  if (params.equalise) equalise(smooth);
  level.image = smooth;
  return level;
}

cv::Mat coloursAlone(const cv::Mat& level) {
  cv::Mat colours;
  if (level.channels() != 3) return colours;
  const float half = static_cast<float>(0.5 * kColourGain), middle = 128.0F;
  const cv::Matx34f differences(0.0F, -half, half, middle,                 //
                                half, -0.5F * half, -0.5F * half, middle,  //
                                -half, 0.0F, half, middle);
  cv::transform(level, colours, differences);
  return colours;
}

cv::Mat paintAlone(const cv::Mat& level, const Eigen::Vector3f& paint) {
  if (level.channels() != 3) return {};
  cv::Mat painted(level.size(), CV_8UC1);
  std::transform(
      level.begin<cv::Vec3b>(), level.end<cv::Vec3b>(), painted.begin<std::uint8_t>(),
      [&paint](const cv::Vec3b& bgr) {
        const Eigen::Vector3f pixel(bgr[0], bgr[1], bgr[2]);
        return cv::saturate_cast<std::uint8_t>(kUnpainted + kPaintGain * paint.dot(chromaticity(pixel)));
      });
  cv::GaussianBlur(painted, painted, cv::Size(), kPaintSigmaPx, kPaintSigmaPx, cv::BORDER_REPLICATE);
  return painted;
}

std::array<cv::Mat, 2> blobMasks(const cv::Mat& level, int channel, double contrast) {
  cv::Mat smooth, mean;
  cv::extractChannel(level, smooth, channel);
  cv::GaussianBlur(smooth, smooth, cv::Size(), kSigmaPx, kSigmaPx, cv::BORDER_REPLICATE);
  const int side = static_cast<int>(kMeanOver * std::max(level.cols, level.rows)) | 1;
  cv::boxFilter(smooth, mean, -1, cv::Size(side, side));
  return {smooth - mean > contrast, mean - smooth > contrast};
}

}  // namespace window_ingress::detection
