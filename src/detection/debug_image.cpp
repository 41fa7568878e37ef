#include "window_ingress/detection/debug_image.hpp"

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace window_ingress::detection {
namespace {

const cv::Scalar kGreen(0, 220, 0), kYellow(0, 255, 255), kBlack(0, 0, 0);

cv::Scalar colourOf(RejectReason reason) {
  cv::Mat3b pixel(1, 1, cv::Vec3b(static_cast<uchar>(static_cast<int>(reason) * 67 % 180), 190, 255));
  cv::cvtColor(pixel, pixel, cv::COLOR_HSV2BGR);
  return cv::Scalar(pixel(0, 0));
}

void drawQuad(cv::Mat& canvas, const geometry::Quadrilateral& quad, const cv::Scalar& colour, int thickness) {
  std::vector<cv::Point> points;
  for (const Eigen::Vector2d& p : quad) {
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 30000.0) return;
    points.emplace_back(static_cast<int>(std::lround(p.x() * 16)), static_cast<int>(std::lround(p.y() * 16)));
  }
  cv::polylines(canvas, points, true, colour, thickness, cv::LINE_AA, 4);
}

void write(cv::Mat& canvas, const std::string& text, cv::Point at, const cv::Scalar& colour) {
  const double scale = std::max(0.3, canvas.cols / 1600.0);
  cv::putText(canvas, text, at, cv::FONT_HERSHEY_SIMPLEX, scale, kBlack, 3, cv::LINE_AA);
  cv::putText(canvas, text, at, cv::FONT_HERSHEY_SIMPLEX, scale, colour, 1, cv::LINE_AA);
}

// The borders as far as they were seen.
void drawPartial(cv::Mat& canvas, const WindowObservation& window) {
  for (const Edge& edge : window.edges)
    if (edge.visible)
      cv::line(canvas, cv::Point2d(edge.a.x(), edge.a.y()), cv::Point2d(edge.b.x(), edge.b.y()), kGreen, 2,
               cv::LINE_AA);
  write(canvas, cv::format("%d of 4 sides, score %.2f", window.visibleSides(), window.score),
        {4, canvas.rows - 6}, kGreen);
}

void drawLegend(cv::Mat& canvas, const std::array<int, kRejectReasons>& counts) {
  int line = 0;
  const int step = std::max(10, canvas.cols / 50);
  for (int i = 1; i < kRejectReasons; ++i) {
    if (!counts[i]) continue;
    const auto reason = static_cast<RejectReason>(i);
    write(canvas, std::to_string(counts[i]) + " " + toString(reason), {4, step * ++line}, colourOf(reason));
  }
}

}  // namespace

void drawDetection(const cv::Mat& image, const DetectionTrace& trace, const WindowObservation* window,
                   cv::Mat& canvas) {
  if (image.empty() || image.depth() != CV_8U) return;
  if (image.channels() == 1)
    cv::cvtColor(image, canvas, cv::COLOR_GRAY2BGR);
  else
    image.copyTo(canvas);
  std::array<int, kRejectReasons> counts{};
  for (const CandidateTrace& candidate : trace.candidates) {
    ++counts[static_cast<int>(candidate.reject)];
    if (candidate.reject != RejectReason::kNone)
      drawQuad(canvas, candidate.quad, colourOf(candidate.reject), 1);
  }
  drawLegend(canvas, counts);
  const int bottom = canvas.rows - 6;
  if (!window) {
    write(canvas, std::string("no window: ") + toString(trace.outcome) + " " + trace.detail, {4, bottom},
          kYellow);
    return;
  }
  if (!window->whole()) return drawPartial(canvas, *window);
  drawQuad(canvas, window->corners, kGreen, 2);
  const Eigen::Vector2d centre = geometry::centroid(window->corners);
  cv::circle(canvas, cv::Point2d(centre.x(), centre.y()), std::max(3, canvas.cols / 160), kYellow, cv::FILLED,
             cv::LINE_AA);
  write(canvas, cv::format("score %.2f", window->score), {4, bottom}, kGreen);
}

}  // namespace window_ingress::detection
