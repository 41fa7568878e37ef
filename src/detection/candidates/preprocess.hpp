#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// A pyramid level: each pixel is the mean of factor x factor raw pixels.
struct SearchLevel {
  cv::Mat image;  ///< CV_8UC1 or CV_8UC3, smoothed
  int factor = 1;
};

/// Raw pixel at a pixel of the search level; pixel centres are integers in both.
inline Eigen::Vector2d toFullImage(const Eigen::Vector2d& level_px, int factor) {
  return factor * level_px + Eigen::Vector2d::Constant(0.5 * (factor - 1));
}

/// The camera of a search level if its lens distorts the image, so that straight borders are straight lines
/// in the undistorted level only. Points are undistorted, never the image. \param camera of the image, may be
/// null
std::optional<geometry::PinholeCamera> lensOfLevel(const geometry::PinholeCamera* camera,
                                                   const SearchLevel& level);

/// Noise removal and reduction (P2): pyramid down to the search level by pixel averages, Gaussian blur,
/// histogram equalisation. \param image CV_8UC1 or CV_8UC3, not empty; not shared \param smooth an earlier
/// level, whose memory is reused
SearchLevel preprocess(const cv::Mat& image, const PreprocessParams& params, cv::Mat smooth = {});

/// A level without brightness (P23): CV_8UC3, differences between its channels about 128. Empty if it has no
/// colours.
cv::Mat coloursAlone(const cv::Mat& level);

/// A level as the strength of one paint, independent of the light: CV_8UC1, 100 where a pixel's chromaticity
/// has none of it. Empty if it has no colours. \param paint direction of chromaticity, see `RingMeans::paint`
cv::Mat paintAlone(const cv::Mat& level, const Eigen::Vector3f& paint);

/// Masks of the regions of one channel that stand out from their surroundings, however weak or broken their
/// edges are: pixels above, and pixels below, the mean of the surrounding square by more than `contrast`.
/// CV_8UC1, 0 or 255. \param level CV_8UC1 or CV_8UC3 \param contrast [grey levels]
std::array<cv::Mat, 2> blobMasks(const cv::Mat& level, int channel, double contrast);

}  // namespace window_ingress::detection
