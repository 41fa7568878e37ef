#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "detection/reference/ring_colours.hpp"
#include "window_ingress/detection/debug_image.hpp"

namespace window_ingress::detection {
namespace {

const cv::Scalar kOpeningColour(60, 230, 60), kFrameColour(0, 140, 255), kSurroundColour(255, 120, 0);
constexpr double kFaded = 0.45, kTint = 0.3;

std::vector<cv::Point> pixelsOf(const geometry::Quadrilateral& quad) {
  constexpr double kFar = 1e5;
  std::vector<cv::Point> points;
  for (const auto& corner : quad)
    points.emplace_back(cvRound(std::clamp(corner.x(), -kFar, kFar)),
                        cvRound(std::clamp(corner.y(), -kFar, kFar)));
  return points;
}

cv::Mat within(const cv::Size& size, const geometry::Quadrilateral& quad) {
  cv::Mat mask(size, CV_8U, cv::Scalar(0));
  if (geometry::isFinite(quad)) cv::fillConvexPoly(mask, pixelsOf(quad), cv::Scalar(255));
  return mask;
}

void tint(const cv::Mat& image, const cv::Mat& mask, const cv::Scalar& colour, cv::Mat& canvas) {
  cv::Mat tinted;
  cv::addWeighted(image, 1.0 - kTint, cv::Mat(image.size(), image.type(), colour), kTint, 0.0, tinted);
  tinted.copyTo(canvas, mask);
}

void write(cv::Mat& canvas, const std::string& text, int height) {
  cv::copyMakeBorder(canvas, canvas, 0, height, 0, 0, cv::BORDER_CONSTANT, cv::Scalar::all(24));
  const double scale = std::min(height / 40.0, canvas.cols / (20.0 * static_cast<double>(text.size())));
  cv::putText(canvas, text, {6, canvas.rows - height / 3}, cv::FONT_HERSHEY_SIMPLEX, scale,
              cv::Scalar(255, 255, 255), 1, cv::LINE_AA);
}

}  // namespace

cv::Mat drawReference(const ReferenceAppearance& reference) {
  cv::Mat grey = reference.image(), image;  // so that tints look the same on every frame
  if (grey.channels() == 3) cv::cvtColor(reference.image(), grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(grey, image, cv::COLOR_GRAY2BGR);
  const geometry::Quadrilateral& opening = reference.opening();
  const cv::Mat inner = within(image.size(), opening);
  const cv::Mat near = within(image.size(), ringLine(opening, RingHistogram::kFrameWidth));
  const cv::Mat far = within(image.size(), ringLine(opening, RingHistogram::kSurroundWidth));
  cv::Mat canvas;
  image.convertTo(canvas, -1, kFaded);
  tint(image, far & ~near, kSurroundColour, canvas);
  tint(image, near & ~inner, kFrameColour, canvas);
  const int width = std::max(1, image.cols / 400);
  cv::polylines(canvas, std::vector<std::vector<cv::Point>>{pixelsOf(opening)}, true, kOpeningColour, width,
                cv::LINE_AA);
  cv::circle(canvas, pixelsOf(opening)[0], 3 * width + 1, kOpeningColour, cv::FILLED, cv::LINE_AA);
  write(canvas,
        std::string(reference.openingIsKnown() ? "green: inner border of the opening"
                                               : "green: opening, GUESSED") +
            "; orange: frame, blue: surround, whose colours are compared",
        std::max(20, image.rows / 20));
  return canvas;
}

}  // namespace window_ingress::detection
