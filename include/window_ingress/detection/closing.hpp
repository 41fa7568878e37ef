#pragma once

#include <opencv2/core.hpp>

namespace window_ingress::detection {

struct ClosingParams {
  double radius = 0.003;  ///< of the dilation, in longer sides of the level; at least one pixel

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("radius", self.radius, 0.0, 0.1);
  }
};

/// Closes the holes of an edge map by dilation (P6). Borders move outwards by `radiusPx`; only the search
/// sees that.
class Closing {
 public:
  explicit Closing(const ClosingParams& params) : params_(params) {}

  int radiusPx(const cv::Size& size) const;

  /// \param edges CV_8UC1. The result stays valid until the next call.
  const cv::Mat& run(const cv::Mat& edges);

 private:
  ClosingParams params_;
  cv::Mat closed_, kernel_;
};

}  // namespace window_ingress::detection
