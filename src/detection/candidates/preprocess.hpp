#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "window_ingress/detection/detector_params.hpp"

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

/// Noise removal and reduction (P2): pyramid down to the search level by pixel averages, Gaussian blur,
/// histogram equalisation.
class Preprocess {
 public:
  explicit Preprocess(const PreprocessParams& params) : params_(params) {}

  /// \param image CV_8UC1 or CV_8UC3, not empty. The result may share the object's buffers until the next
  /// call.
  SearchLevel run(const cv::Mat& image);

  /// The last level without brightness (P23): CV_8UC3, differences between its channels about 128. Empty if
  /// it has no colours.
  const cv::Mat& coloursAlone();

  /// The last level as the strength of one paint, independent of the light: CV_8UC1, 100 where a pixel's
  /// chromaticity has none of it. Empty if it has no colours. \param paint direction of chromaticity, see
  /// `RingMeans::paint`
  const cv::Mat& paintAlone(const Eigen::Vector3f& paint);

 private:
  void equalise(cv::Mat& image);

  PreprocessParams params_;
  cv::Mat levels_[2], smooth_, lab_, colours_;
};

/// Regions of one channel that stand out from their surroundings, however weak or broken their edges are.
class BlobMasks {
 public:
  enum class Sign { kAbove, kBelow };

  /// Sets the channel for `run`. \param level CV_8UC1 or CV_8UC3
  void take(const cv::Mat& level, int channel);

  /// Mask of pixels above, or below, the mean of the surrounding square by more than `contrast`: CV_8UC1, 0
  /// or 255. Valid until the next call. \param contrast [grey levels]
  const cv::Mat& run(Sign sign, double contrast);

 private:
  cv::Mat channel_, mean_, difference_, mask_;
};

}  // namespace window_ingress::detection
