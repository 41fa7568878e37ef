#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Writes on images, in a size that follows theirs, and keeps texts off each other.
class TextOverlay {
 public:
  /// \param canvas CV_8UC3; must outlive this object
  explicit TextOverlay(cv::Mat& canvas);

  struct Line {
    std::string text;
    cv::Scalar colour;
  };

  /// A dark box with these lines, white, each behind a patch of its colour, in a corner of the canvas that is
  /// free, else in the upper left one; as many as fit into three fifths of its height. The footer, if there
  /// is to be one, comes first.
  void box(const std::vector<Line>& lines);

  /// One line along the lower border; its end is cut off if it is too long.
  void footer(const Line& line);

  /// A text beside a point if there is room, inside the canvas and off all other texts. \return false if not
  bool label(const Line& line, const cv::Point& at);

  /// No label will be put there, unless it is most of the canvas.
  void keepFree(const cv::Rect& area);

 private:
  cv::Size sizeOf(const std::string& text) const;
  void backdrop(const cv::Rect& area);
  void write(const std::string& text, const cv::Point& baseline, const cv::Scalar& colour);
  bool isFree(const cv::Rect& area) const;
  cv::Point freeCorner(const cv::Size& size) const;

  cv::Mat& canvas_;
  double scale_;
  int height_;
  std::vector<cv::Rect> taken_;
};

/// Sides of a quadrilateral, antialiased; nothing if it is not finite or far outside any image.
void drawQuad(cv::Mat& canvas, const geometry::Quadrilateral& quad, const cv::Scalar& colour, int thickness);

}  // namespace window_ingress::detection
