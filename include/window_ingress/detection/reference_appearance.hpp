#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

struct AppearanceParams {
  double near_width =
      0.05;  ///< first band of the ring round the border: the frame, in mean sides of the opening
  double far_width = 0.14;  ///< second band, its outer edge: frame and surround, in mean sides of the opening
  int min_pixels = 40;      ///< fewer pixels in a band are not compared
  double max_distance = 0.75;  ///< Bhattacharyya distance beyond which a candidate is not the target, 0 to 1

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("near_width", self.near_width, 0.005, 0.5);
    field("far_width", self.far_width, 0.01, 1.0);
    field("min_pixels", self.min_pixels, 1, 100000);
    field("max_distance", self.max_distance, 0.0, 1.0);
  }
};

/// Colour histogram of the ring round an opening: chroma in two bands, the frame and its surround. What is
/// seen through the opening, and how bright things are, does not count. \return CV_32FC1, each band summing
/// to 1/2; nothing if the picture has no colour or a band too few pixels
std::optional<cv::Mat> ringHistogram(const cv::Mat& image, const geometry::Quadrilateral& opening,
                                     const AppearanceParams& params);

/// How the target looks (P9): made once from a picture of it.
class ReferenceAppearance {
 public:
  /// \param picture CV_8UC3 (a grey one gives a reference without colour, which rejects nothing)
  /// \param opening inner border of the opening in the picture, canonical order; frame and surround lie
  /// outside
  ReferenceAppearance(const cv::Mat& picture, const geometry::Quadrilateral& opening);

  /// The whole picture is the target with its frame; `frame_width` is that of the frame, in mean sides of the
  /// picture.
  explicit ReferenceAppearance(const cv::Mat& picture, double frame_width = 0.05);

  /// Bhattacharyya distance (0 identical, 1 disjoint) of a candidate's ring; nothing if there is no colour to
  /// compare.
  std::optional<double> distance(const cv::Mat& image, const geometry::Quadrilateral& opening,
                                 const AppearanceParams& params) const;

  const cv::Mat& picture() const { return picture_; }
  const geometry::Quadrilateral& opening() const { return opening_; }

 private:
  cv::Mat picture_;
  geometry::Quadrilateral opening_;
  mutable std::optional<cv::Mat> histogram_;
  mutable AppearanceParams histogram_params_;
};

}  // namespace window_ingress::detection
