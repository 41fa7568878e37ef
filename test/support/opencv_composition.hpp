/// The detector as it is composed of OpenCV's functions alone: what ours is compared with.
#pragma once

#include <opencv2/imgproc.hpp>
#include <vector>

namespace window_ingress::test {

/// Grey, blur, Canny, closing, contours, polygons with four convex corners; the largest of them, or none.
/// Not the paper's whole method: no line support, reference, frame or sub-pixel borders.
inline std::vector<cv::Point> opencvComposition(const cv::Mat& image) {
  cv::Mat grey, edges;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  cv::GaussianBlur(grey, grey, cv::Size(5, 5), 1.0);
  cv::Canny(grey, edges, 50, 150);
  cv::dilate(edges, edges, cv::getStructuringElement(cv::MORPH_RECT, cv::Size(3, 3)));
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(edges, outlines, cv::RETR_LIST, cv::CHAIN_APPROX_SIMPLE);
  std::vector<cv::Point> polygon, best;
  for (const auto& outline : outlines) {
    cv::approxPolyDP(outline, polygon, 0.02 * cv::arcLength(outline, true), true);
    if (polygon.size() != 4 || !cv::isContourConvex(polygon)) continue;
    if (best.empty() || cv::contourArea(polygon) > cv::contourArea(best)) best = polygon;
  }
  return best;
}

}  // namespace window_ingress::test
