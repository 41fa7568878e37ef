#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Writes texts on images without overlap, in a size proportional to the image.
class TextOverlay {
 public:
  /// \param canvas CV_8UC3; must outlive this object
  explicit TextOverlay(cv::Mat& canvas);

  struct Line {
    std::string text;
    cv::Scalar colour;
  };

  /// A dark box with these lines in white, each after a patch of its colour, in a free corner of the canvas
  /// or else the upper left one. It holds as many lines as fit into three fifths of the height. Call `footer`
  /// first if there is one.
  void box(const std::vector<Line>& lines);

  /// One line along the lower border; its end is cut off if it is too long.
  void footer(const Line& line);

  /// A text next to a point, if there is room on the canvas beside all other texts. \return false if not
  bool label(const Line& line, const cv::Point& at);

  /// Keeps labels out of an area, unless the area is most of the canvas.
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

/// Draws a quadrilateral, antialiased; nothing if it is not finite or far outside any image.
void drawQuad(cv::Mat& canvas, const geometry::Quadrilateral& quad, const cv::Scalar& colour, int thickness);

}  // namespace window_ingress::detection
