#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace window_ingress::evaluation {

/// The same with three channels.
cv::Mat coloured(const cv::Mat& image);

/// Images side by side, row by row, all equally wide, each with a line of text below.
class ContactSheet {
 public:
  ContactSheet(int columns, int cell_width_px) : columns_(columns), width_px_(cell_width_px) {}

  void add(const cv::Mat& image, const std::string& caption);
  cv::Mat draw() const;  ///< CV_8UC3; empty if nothing was added

 private:
  int columns_, width_px_;
  std::vector<cv::Mat> cells_;
};

}  // namespace window_ingress::evaluation
