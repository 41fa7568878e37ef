#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "detection/alignment/rectangle_prior.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

std::array<float, 257> logsOfColours();
inline const std::array<float, 257> kLogsOfColours = logsOfColours();

/// Logarithm of a colour, 0 to 255: a factor of the light becomes an offset.
inline float logOf(float value) {
  const int whole = static_cast<int>(value);
  return kLogsOfColours[whole] +
         (value - static_cast<float>(whole)) * (kLogsOfColours[whole + 1] - kLogsOfColours[whole]);
}

inline constexpr int kRingChannels = 3;  ///< of all images; equal for a grey image

/// The ring round the opening at one resolution: points of the opening's plane and the colours there. Points
/// are ordered by segment.
struct RingLevel {
  double side_px = 0.0;                   ///< samples per mean side of the opening
  std::vector<float> x, y;                ///< from the opening's centre [its sides]: -0.5 .. 0.5 within it
  std::vector<float> monomials;           ///< of x and y, 16 per point
  std::vector<float> values;              ///< logarithms of the colours, channel by channel
  std::vector<float> slopes_x, slopes_y;  ///< change of `values` per side of the opening
  std::vector<int> segments;  ///< first sample of each, and the end; light is assumed even over a segment

  int size() const { return static_cast<int>(x.size()); }
  int segmentCount() const { return static_cast<int>(segments.size()) - 1; }
};

/// Surroundings of the opening in the operator's image, at several resolutions: a flat ring of frame and
/// wall, which a homography maps into any image. What lies within the opening or outside the image does not
/// count.
struct RingModel {
  static constexpr double kWidth = 0.22;  ///< of the ring [mean sides of the opening]

  float colour = 1.0F;  ///< weight of the differences between channels, relative to brightness
  std::optional<OpeningAspect> aspect;  ///< of the opening, where known
  bool framed = false;            ///< the ring shows a frame, which may stand out of the opening's plane
  std::vector<RingLevel> levels;  ///< the coarsest first; none: nothing is known

  /// Samples the levels. \param image CV_8UC3 \param opening canonical order, in pixels of the image
  void learn(const cv::Mat& image, const geometry::Quadrilateral& opening);
  bool known() const { return !levels.empty(); }

  /// Weights the differences between the channels' logarithms, for `count` points.
  void weighColour(float* blue, float* green, float* red, std::size_t count) const {
    const float weight = colour;
    for (std::size_t i = 0; i < count; ++i) {
      const float brightness = (blue[i] + green[i] + red[i]) / 3.0F;
      blue[i] = brightness + weight * (blue[i] - brightness);
      green[i] = brightness + weight * (green[i] - brightness);
      red[i] = brightness + weight * (red[i] - brightness);
    }
  }

  /// The level nearest to this resolution; levels differ by factors of the square root of two.
  const RingLevel& level(double side_px) const;
};

}  // namespace window_ingress::detection
