/// The paper's pipeline, composed of OpenCV functions. The detector is compared with it.
#pragma once

#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

namespace window_ingress::test {

/// The steps of the paper in its order, on the image at full size: grey, Gaussian blur, pyramid down and up,
/// histogram equalisation (P2), Canny (P3), probabilistic Hough lines drawn in place of the edges (P4),
/// dilation (P6), contours and polygons (P7), the gates on area, aspect ratio, hull and angles (P8), the
/// histogram's Bhattacharyya distance from the reference (P9). The numbers that the paper leaves to trackbars
/// are those of OpenCV's own examples. Buffers are kept from image to image.
class OpencvComposition {
 public:
  /// \param with_hough false: the edges are dilated directly
  explicit OpencvComposition(bool with_hough = true) : with_hough_(with_hough) {}

  /// \param image BGR \param opening inner border of the opening in it
  void setReference(const cv::Mat& image, const std::vector<cv::Point>& opening) {
    reference_ = histogram(image, opening);
  }

  /// \param image CV_8UC3 \return the largest outline that passes, four corners; or nothing
  std::vector<cv::Point> run(const cv::Mat& image) {
    findEdges(image);
    if (with_hough_) redrawLines();
    cv::dilate(edges_, edges_, cv::getStructuringElement(cv::MORPH_RECT, cv::Size(3, 3)));
    cv::findContours(edges_, outlines_, cv::RETR_LIST, cv::CHAIN_APPROX_SIMPLE);
    std::vector<cv::Point> best, polygon;
    for (const auto& outline : outlines_) {
      cv::approxPolyDP(outline, polygon, 0.02 * cv::arcLength(outline, true), true);
      if (!isWindow(outline, polygon, image.size().area())) continue;
      if (!best.empty() && cv::contourArea(polygon) <= cv::contourArea(best)) continue;
      if (looksLikeReference(image, polygon)) best = polygon;
    }
    return best;
  }

 private:
  static constexpr double kMinArea = 0.003, kMaxArea = 0.9;    ///< of the image
  static constexpr double kMinAspect = 0.2, kMaxAspect = 3.5;  ///< width over height
  static constexpr double kMinSolidity = 0.8, kMaxCosine = 0.75, kMaxDistance = 0.7;

  void findEdges(const cv::Mat& image) {
    cv::cvtColor(image, grey_, cv::COLOR_BGR2GRAY);
    cv::GaussianBlur(grey_, grey_, cv::Size(5, 5), 0.0);
    cv::pyrDown(grey_, half_);
    cv::pyrUp(half_, grey_, image.size());
    cv::equalizeHist(grey_, grey_);
    cv::Canny(grey_, edges_, 50, 200);
  }

  void redrawLines() {
    cv::HoughLinesP(edges_, lines_, 1.0, CV_PI / 180.0, 50, 50.0, 10.0);
    edges_.setTo(0);
    for (const cv::Vec4i& line : lines_)
      cv::line(edges_, cv::Point(line[0], line[1]), cv::Point(line[2], line[3]), cv::Scalar(255), 3);
  }

  static double cosine(const cv::Point& before, const cv::Point& corner, const cv::Point& after) {
    const cv::Point2d a = before - corner, b = after - corner;
    return a.dot(b) / std::sqrt(a.dot(a) * b.dot(b) + 1e-12);
  }

  static bool isWindow(const std::vector<cv::Point>& outline, const std::vector<cv::Point>& polygon,
                       double image_area) {
    if (polygon.size() != 4 || !cv::isContourConvex(polygon)) return false;
    const double area = cv::contourArea(outline);
    if (area < kMinArea * image_area || area > kMaxArea * image_area) return false;
    const cv::Rect box = cv::boundingRect(polygon);
    const double aspect = static_cast<double>(box.width) / box.height;
    if (aspect < kMinAspect || aspect > kMaxAspect) return false;
    std::vector<cv::Point> hull;
    cv::convexHull(outline, hull);
    if (area < kMinSolidity * cv::contourArea(hull)) return false;
    for (int i = 0; i < 4; ++i)
      if (std::abs(cosine(polygon[i], polygon[(i + 1) % 4], polygon[(i + 2) % 4])) > kMaxCosine) return false;
    return true;
  }

  /// Histogram of hue and saturation in the bounding box of the outline.
  static cv::Mat histogram(const cv::Mat& image, const std::vector<cv::Point>& outline) {
    const cv::Rect box = cv::boundingRect(outline) & cv::Rect(cv::Point(0, 0), image.size());
    cv::Mat hsv, counts;
    cv::cvtColor(image(box), hsv, cv::COLOR_BGR2HSV);
    const std::array<int, 2> channels = {0, 1}, bins = {30, 32};
    const float hue[] = {0, 180}, saturation[] = {0, 256};
    const float* ranges[] = {hue, saturation};
    cv::calcHist(&hsv, 1, channels.data(), cv::noArray(), counts, 2, bins.data(), ranges);
    cv::normalize(counts, counts, 1.0, 0.0, cv::NORM_L1);
    return counts;
  }

  bool looksLikeReference(const cv::Mat& image, const std::vector<cv::Point>& polygon) const {
    return !reference_ ||
           cv::compareHist(*reference_, histogram(image, polygon), cv::HISTCMP_BHATTACHARYYA) <= kMaxDistance;
  }

  bool with_hough_;
  std::optional<cv::Mat> reference_;
  cv::Mat grey_, half_, edges_;
  std::vector<cv::Vec4i> lines_;
  std::vector<std::vector<cv::Point>> outlines_;
};

}  // namespace window_ingress::test
