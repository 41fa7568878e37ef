#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "detection/alignment/ring_model.hpp"

namespace window_ingress::detection {

/// Where in an image the opening may be, without any edge being found: the slopes of brightness along its
/// four sides, upright and as the reference shows them, are correlated with the whole image at every size.
/// Each side may lie a pixel off, a fourteenth of a side: a view from elsewhere moves them by that. At the
/// best places each half of a side is then put where it fits best, so that the place leans as the view does;
/// the alignment does the rest. Keeps its memory.
class RingSearch {
 public:
  struct Place {
    geometry::Quadrilateral quad;  ///< pixels of the image
    double correlation;            ///< mean of the sides'
    double factor;                 ///< by which the image is made smaller there
    cv::Point at;                  ///< of the pattern in that
  };

  /// \param image CV_8UC3 \param opening canonical order, in its pixels
  void learn(const cv::Mat& image, const geometry::Quadrilateral& opening);
  void forget() { sides_.clear(); }
  bool known() const { return !sides_.empty(); }

  /// Best first, each place once, at most `most`. Valid until the next call.
  /// \param image CV_8UC3 \param leaning false: upright, as the reference shows it
  const std::vector<Place>& run(const cv::Mat& image, std::size_t most, bool leaning = true);

 private:
  /// What the reference shows along one side.
  struct Side {
    cv::Rect at;  ///< in the pattern
    cv::Mat slopes_x, slopes_y;
    double squares;  ///< their sum
    bool is_level;   ///< top or bottom
  };
  /// Across a side, from the pattern's corner on [px].
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
  cv::Size2d opening_;  ///< in the middle of the pattern [px]
  std::vector<Side> sides_;
  ImagePyramid pyramid_;
  cv::Mat grey_, level_, logs_, slopes_x_, slopes_y_, squares_;  ///< of one size of the image
  cv::Mat alike_, alike_y_, norm_, sum_, peaks_;
  std::vector<Place> places_;
};

}  // namespace window_ingress::detection
