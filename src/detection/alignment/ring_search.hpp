#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "detection/alignment/ring_model.hpp"
#include "detection/image_pyramid.hpp"

namespace window_ingress::detection {

/// Searches an image for the opening without edge detection. The brightness slopes along the four sides,
/// upright as in the reference, are correlated with the whole image at every size. Each side may lie one
/// pixel off (a fourteenth of a side) to allow for another viewpoint. At the best places each half of a side
/// is then moved to its best fit, so that the place leans as the view does. RingAlignment does the rest.
/// Keeps its memory.
class RingSearch {
 public:
  struct Place {
    geometry::Quadrilateral quad;  ///< pixels of the image
    double correlation;            ///< mean over the sides
    double factor;                 ///< scale of the reduced image
    cv::Point at;                  ///< of the pattern in the reduced image
  };

  /// \param image CV_8UC3 \param opening canonical order, in pixels of the image
  void learn(const cv::Mat& image, const geometry::Quadrilateral& opening);

  /// Places, best first, each place once, at most `most`; none before `learn`. Valid until the next call.
  /// \param image CV_8UC3 \param leaning false: upright, as the reference shows it
  const std::vector<Place>& run(const cv::Mat& image, std::size_t most, bool leaning = true);

 private:
  /// What the reference shows along one side.
  struct Side {
    cv::Rect at;  ///< in the pattern
    cv::Mat slopes_x, slopes_y;
    bool is_level;  ///< top or bottom
  };
  /// Offset across a side as a line, from the pattern's corner [px].
  struct Line {
    double at0, slope;
  };
  void readSlopes(const cv::Mat& grey);
  bool shrink(double factor);
  bool correlate(double factor);
  double likeness(const Side& side, const cv::Rect& part, const cv::Point& at) const;
  double offAcross(const Side& side, const cv::Rect& part, const cv::Point& at) const;
  Line settled(const Side& side, const cv::Point& at) const;
  void settle(Place& place);
  void takePeaks(double factor);

  cv::Size pattern_;
  cv::Rect2d opening_;  ///< in the middle of the pattern [px]
  std::vector<Side> sides_;
  ImagePyramid pyramid_;
  cv::Mat grey_, level_, logs_, slopes_x_, slopes_y_, squares_;  ///< at one size of the image
  cv::Mat alike_, alike_y_, norm_, sum_, peaks_;
  std::vector<Place> places_;
};

}  // namespace window_ingress::detection
