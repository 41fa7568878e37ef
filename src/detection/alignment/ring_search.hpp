#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "detection/alignment/ring_model.hpp"

namespace window_ingress::detection {

/// Where in an image the ring may be, without any edge: its coarsest level, upright and as the reference
/// shows it, is correlated with the whole image at every size, all of the ring with one gain and one offset a
/// channel. Within a twelfth of a side or so: the alignment does the rest. Keeps its memory.
class RingSearch {
 public:
  struct Place {
    geometry::Quadrilateral quad;  ///< pixels of the image
    double correlation;
  };

  void learn(const RingModel& model);
  void forget() { pattern_.release(); }
  bool known() const { return !pattern_.empty(); }

  /// Best first, each place once, at most `most`. Valid until the next call. \param model the one learned
  /// \param image with as many channels
  const std::vector<Place>& run(const RingModel& model, const cv::Mat& image, std::size_t most);

 private:
  bool correlate(const RingModel& model, double factor);
  void takePeaks(double factor);

  cv::Mat pattern_, mask_;  ///< zero mean under the mask
  double norm_ = 0.0, count_ = 0.0;
  cv::Size2d opening_;  ///< in the pattern [px]
  ImagePyramid pyramid_;
  cv::Mat level_, logs_, squares_, alike_, sum_, variance_, peaks_;
  std::vector<cv::Mat> channels_;
  std::vector<Place> places_;
};

}  // namespace window_ingress::detection
