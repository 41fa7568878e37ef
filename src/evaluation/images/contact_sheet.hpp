#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace window_ingress::evaluation {

/// The image with three channels.
inline cv::Mat coloured(const cv::Mat& image) {
  if (image.channels() != 1) return image.clone();
  cv::Mat result;
  cv::cvtColor(image, result, cv::COLOR_GRAY2BGR);
  return result;
}

/// Images side by side, row by row, all equally wide, each with a line of text below.
class ContactSheet {
 public:
  ContactSheet(int columns, int cell_width_px) : columns_(columns), width_px_(cell_width_px) {}

  void add(const cv::Mat& image, const std::string& caption) {
    cv::Mat cell;
    cv::resize(coloured(image), cell, {width_px_, width_px_ * image.rows / image.cols}, 0, 0,
               image.cols > width_px_ ? cv::INTER_AREA : cv::INTER_LINEAR);
    const int text_px = std::max(16, width_px_ / 22);
    cv::copyMakeBorder(cell, cell, kGap_px, text_px, kGap_px, 0, cv::BORDER_CONSTANT, cv::Scalar::all(24));
    cv::putText(cell, caption, {kGap_px + 2, cell.rows - text_px / 4}, cv::FONT_HERSHEY_SIMPLEX,
                width_px_ / 1050.0, cv::Scalar::all(255), 1, cv::LINE_AA);
    cells_.push_back(cell);
  }

  /// CV_8UC3; empty if nothing was added.
  cv::Mat draw() const {
    if (cells_.empty()) return {};
    const int count = static_cast<int>(cells_.size()), columns = std::min(columns_, count);
    cv::Size size;
    for (const cv::Mat& cell : cells_) size = {cell.cols, std::max(size.height, cell.rows)};
    cv::Mat sheet((count + columns - 1) / columns * size.height + kGap_px, columns * size.width + kGap_px,
                  CV_8UC3, cv::Scalar::all(24));
    for (int i = 0; i < count; ++i)
      cells_[i].copyTo(
          sheet(cv::Rect({i % columns * size.width, i / columns * size.height}, cells_[i].size())));
    return sheet;
  }

 private:
  static constexpr int kGap_px = 6;

  int columns_, width_px_;
  std::vector<cv::Mat> cells_;
};

}  // namespace window_ingress::evaluation
