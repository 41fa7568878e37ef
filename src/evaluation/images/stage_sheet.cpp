#include "evaluation/images/stage_sheet.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "detection/candidates/candidate_search.hpp"
#include "evaluation/images/contact_sheet.hpp"
#include "window_ingress/detection/debug_image.hpp"
#include "window_ingress/detection/text_overlay.hpp"
#include "window_ingress/detection/window_detector.hpp"

namespace window_ingress::evaluation {
namespace {

using detection::DetectorParams;

constexpr int kSheetColumns = 3, kSmallest_px = 64;
constexpr double kBackground = 0.35;  ///< brightness of the image behind the drawn results
const cv::Scalar kGreen(60, 230, 60), kOrange(60, 170, 255), kBlue(255, 190, 90);

/// The search level, enlarged so that lines of one pixel stay thin.
struct Canvas {
  explicit Canvas(const cv::Mat& level) {
    cv::resize(coloured(level), image, cv::Size(), kZoom, kZoom, cv::INTER_LINEAR);
    image.convertTo(image, -1, kBackground);
  }
  static Eigen::Vector2d at(const Eigen::Vector2d& p) {
    return kZoom * p + Eigen::Vector2d::Constant(0.5 * (kZoom - 1));
  }
  void draw(const geometry::Quadrilateral& q, const cv::Scalar& colour) {
    detection::drawQuad(image, {at(q[0]), at(q[1]), at(q[2]), at(q[3])}, colour, 1);
  }
  static constexpr double kZoom = 2.0;
  cv::Mat image;
};

cv::Scalar colourOfDirection(const Eigen::Vector2d& normal) {
  const double half_turns = std::atan2(normal.y(), normal.x()) / CV_PI;
  cv::Mat3b colour(1, 1,
                   cv::Vec3b(cv::saturate_cast<uchar>(std::fmod(half_turns + 2.0, 1.0) * 179), 160, 255));
  cv::cvtColor(colour, colour, cv::COLOR_HSV2BGR);
  return cv::Scalar(colour(0, 0));
}

template <typename Segments>
cv::Mat drawSegments(const cv::Mat& level, const Segments& segments) {
  Canvas canvas(level);
  for (const auto& segment : segments) {
    const Eigen::Vector2d a = Canvas::at(segment.a), b = Canvas::at(segment.b);
    cv::line(canvas.image, cv::Point2d(a.x(), a.y()), cv::Point2d(b.x(), b.y()),
             colourOfDirection(segment.normal), 2, cv::LINE_AA);
  }
  return canvas.image;
}

cv::Mat drawOutlines(const cv::Mat& closed, const std::vector<detection::Candidate>& candidates) {
  Canvas canvas(closed);
  std::vector<std::vector<cv::Point>> outlines;
  cv::Mat large;
  cv::resize(closed, large, canvas.image.size(), 0, 0, cv::INTER_NEAREST);
  cv::findContours(large, outlines, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  canvas.image.setTo(cv::Scalar::all(0));
  cv::drawContours(canvas.image, outlines, -1, cv::Scalar::all(120));
  for (const auto& candidate : candidates) canvas.draw(candidate.quad, kOrange);
  return canvas.image;
}

cv::Mat drawQuads(const cv::Mat& level, const std::vector<detection::Candidate>& candidates) {
  Canvas canvas(level);
  for (const auto& candidate : candidates) canvas.draw(candidate.quad, kBlue);
  return canvas.image;
}

void addPassed(const cv::Mat& image, const detection::DetectionTrace& trace, ContactSheet& sheet) {
  cv::Mat canvas = coloured(image);
  canvas.convertTo(canvas, -1, kBackground);
  int count = 0;
  for (const auto& candidate : trace.candidates) {
    if (candidate.score <= 0.0) continue;
    ++count;
    const cv::Scalar colour =
        candidate.reject == detection::RejectReason::kNone ? kGreen : detection::colourOf(candidate.reject);
    detection::drawQuad(canvas, candidate.quad, colour, std::max(1, canvas.cols / 640));
  }
  sheet.add(canvas, cv::format("P8, P9 passed the gates on shape (%d)", count));
}

void addStages(const cv::Mat& image, const DetectorParams& params, ContactSheet& sheet) {
  detection::EdgeChains runs;
  detection::HoughSegments lines(params.lines);
  detection::SegmentQuads quads(params.segment_quads);
  const detection::SearchLevel level = detection::preprocess(image, params.preprocess);
  const detection::EdgeMap map = detection::cannyEdges(level.image, params.edges);
  sheet.add(image, cv::format("input, %d x %d", image.cols, image.rows));
  sheet.add(detection::cannyEdges(image, params.edges).edges, "P3 edges without preprocessing");
  sheet.add(map.edges,
            cv::format("P2, P3 edges of the search level, %d x %d", level.image.cols, level.image.rows));
  // Without a calibration the image counts as free of distortion.
  const auto& segments = lines.run(runs.run(map, nullptr), level.image.size());
  sheet.add(drawSegments(level.image, segments),
            cv::format("P4 straight segments, colour: direction (%d)", static_cast<int>(segments.size())));
  cv::Mat closed;
  const int dilation_px =
      detection::closeGaps(edgesOnSegments(runs, lines, level.image.size()), params.closing, closed);
  sheet.add(closed, cv::format("P6 closed, %d px", dilation_px));
  detection::Outlines outlines;
  detection::addOutlines(closed, dilation_px, params.contours, detection::CandidateSource::kContour,
                         outlines);
  sheet.add(drawOutlines(closed, outlines.candidates),
            cv::format("P7 contours (%d), polygons with four sides (%d)", outlines.contours,
                       static_cast<int>(outlines.candidates.size())));
  const auto found =
      quads.run(segments, params.gates.min_area * level.image.size().area(), detection::SegmentQuads::kQuick);
  sheet.add(drawQuads(level.image, found.candidates),
            cv::format("P4, P7 quadrilaterals of segments (%d)", static_cast<int>(found.candidates.size())));
}

void addResult(const cv::Mat& image, const DetectorParams& params,
               const detection::ReferenceAppearance* reference, ContactSheet& sheet) {
  detection::WindowDetector detector(params);
  if (reference) detector.setReference(*reference);
  const auto window = detector.detect(image, 0.0);
  addPassed(image, detector.trace(), sheet);
  cv::Mat result = coloured(image);
  std::string caption = "P10 no target: " + detector.trace().detail;
  if (window) {
    detection::drawQuad(result, window->corners, kGreen, std::max(2, result.cols / 320));
    const Eigen::Vector2d centre = geometry::centroid(window->corners);
    cv::circle(result, cv::Point2d(centre.x(), centre.y()), std::max(3, result.cols / 120),
               cv::Scalar(0, 255, 255), cv::FILLED, cv::LINE_AA);
    caption = cv::format("P10 the target, score %.2f", window->score);
    if (window->has_appearance)
      caption += cv::format(", distance to the reference %.2f", window->bhattacharyya);
  }
  sheet.add(result, caption);
}

}  // namespace

cv::Mat stageSheet(const cv::Mat& image, const DetectorParams& params,
                   const detection::ReferenceAppearance* reference, int cell_width_px) {
  if ((image.type() != CV_8UC1 && image.type() != CV_8UC3) || std::min(image.cols, image.rows) < kSmallest_px)
    throw std::invalid_argument("needs an 8-bit image, grey or colour, of at least 64 x 64 pixels");
  if (cell_width_px < kSmallest_px) throw std::invalid_argument("the images on the sheet are too small");
  ContactSheet sheet(kSheetColumns, cell_width_px);
  addStages(image, params, sheet);
  addResult(image, params, reference, sheet);
  return sheet.draw();
}

}  // namespace window_ingress::evaluation
