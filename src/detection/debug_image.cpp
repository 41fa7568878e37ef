#include "window_ingress/detection/debug_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "window_ingress/detection/text_overlay.hpp"

namespace window_ingress::detection {
namespace {

const cv::Scalar kGreen(60, 230, 60), kYellow(0, 255, 255);

constexpr double kDim = 0.8;    ///< part of the image's brightness that remains, so that lines stand out
constexpr double kFaint = 0.4;  ///< strength of candidates that failed before they had a score
constexpr int kLabels = 5;      ///< candidates explained in words

bool hasScore(const CandidateTrace& candidate) { return candidate.score > 0.0; }

// Duplicates tell nothing beyond the better candidate.
bool isWorthWords(const CandidateTrace& candidate) {
  return candidate.reject != RejectReason::kNone && candidate.reject != RejectReason::kDuplicate &&
         candidate.reject != RejectReason::kCorners;
}

int lineWidth(const cv::Mat& canvas) { return std::max(1, canvas.cols / 800); }

void drawCandidates(cv::Mat& canvas, const DetectionTrace& trace) {
  const auto draw = [&](bool has_score) {
    for (const CandidateTrace& candidate : trace.candidates)
      if (hasScore(candidate) == has_score && candidate.reject != RejectReason::kNone)
        drawQuad(canvas, candidate.quad, colourOf(candidate.reject), lineWidth(canvas));
  };
  const cv::Mat before = canvas.clone();
  draw(false);
  cv::addWeighted(canvas, kFaint, before, 1.0 - kFaint, 0.0, canvas);
  draw(true);
}

std::vector<TextOverlay::Line> legendOf(const DetectionTrace& trace) {
  std::array<int, kRejectReasons> counts{};
  for (const CandidateTrace& candidate : trace.candidates) ++counts[static_cast<int>(candidate.reject)];
  std::vector<TextOverlay::Line> lines;
  for (int i = 1; i < kRejectReasons; ++i) {
    const auto reason = static_cast<RejectReason>(i);
    if (counts[i] == 0) continue;
    lines.push_back({std::to_string(counts[i]) + "  " + toString(reason), colourOf(reason)});
  }
  return lines;
}

cv::Point pixel(const Eigen::Vector2d& p) {
  const Eigen::Vector2d bounded = p.cwiseMax(-1e4).cwiseMin(1e4);
  return {static_cast<int>(std::lround(bounded.x())), static_cast<int>(std::lround(bounded.y()))};
}

cv::Rect boxRound(const geometry::Quadrilateral& quad) {
  const std::array<cv::Point, 4> corners = {pixel(quad[0]), pixel(quad[1]), pixel(quad[2]), pixel(quad[3])};
  return cv::boundingRect(corners);
}

// Order: candidates that a gate stopped before those that were only outscored; then by score; then by area.
bool isMoreWorth(const CandidateTrace* a, const CandidateTrace* b) {
  const bool a_stopped = a->reject != RejectReason::kOutscored,
             b_stopped = b->reject != RejectReason::kOutscored;
  if (a_stopped != b_stopped) return a_stopped;
  if (a->score != b->score) return a->score > b->score;
  return std::abs(geometry::signedArea(a->quad)) > std::abs(geometry::signedArea(b->quad));
}

// Labels a few candidates, each at a different place.
void explainBest(TextOverlay& overlay, const DetectionTrace& trace) {
  constexpr double kSamePlace = 0.5;
  std::vector<const CandidateTrace*> all, told;
  for (const CandidateTrace& candidate : trace.candidates)
    if (isWorthWords(candidate) && geometry::isFinite(candidate.quad)) all.push_back(&candidate);
  std::stable_sort(all.begin(), all.end(), isMoreWorth);
  for (const CandidateTrace* one : all) {
    if (told.size() == kLabels) return;
    if (std::any_of(told.begin(), told.end(), [&](const CandidateTrace* other) {
          return geometry::intersectionOverUnion(one->quad, other->quad) > kSamePlace;
        }))
      continue;
    if (overlay.label({describe(*one), colourOf(one->reject)}, pixel(one->quad[geometry::kTopLeft])))
      told.push_back(one);
  }
}

void drawWhole(cv::Mat& canvas, const WindowObservation& window) {
  drawQuad(canvas, window.corners, kGreen, 2 * lineWidth(canvas));
  cv::circle(canvas, pixel(geometry::centroid(window.corners)), std::max(3, canvas.cols / 160), kYellow,
             cv::FILLED, cv::LINE_AA);
}

void drawSides(cv::Mat& canvas, const WindowObservation& window) {
  for (const Edge& edge : window.edges)
    if (edge.visible && edge.a.allFinite() && edge.b.allFinite())
      cv::line(canvas, pixel(edge.a), pixel(edge.b), kGreen, 2 * lineWidth(canvas), cv::LINE_AA);
  for (int i = 0; i < 4; ++i)
    if (window.corner_visible[i])
      cv::circle(canvas, pixel(window.corners[i]), 3 * lineWidth(canvas), kGreen, cv::FILLED, cv::LINE_AA);
}

std::string summaryOf(const DetectionTrace& trace, const WindowObservation* window,
                      std::optional<double> milliseconds) {
  std::string text;
  if (window) {
    text = cv::format("window: score %.2f", window->score);
    if (!window->whole()) text += cv::format(", %d of 4 sides", window->visibleSides());
    text += window->has_appearance ? cv::format(" | distance to reference %.2f", window->bhattacharyya)
                                   : std::string(" | not compared with a reference");
  } else {
    text = std::string("no window: ") + (trace.detail.empty() ? toString(trace.outcome) : trace.detail);
  }
  const std::size_t candidates = trace.candidates.size();
  text += cv::format(" | %d candidate%s", static_cast<int>(candidates), candidates == 1 ? "" : "s");
  if (trace.budget_exceeded) text += " (not all)";
  if (milliseconds) text += cv::format(" | %.1f ms", *milliseconds);
  return text;
}

}  // namespace

cv::Scalar colourOf(RejectReason reason) {
  // Eleven hues without the target's green: pale for the first gates, strong for later ones.
  constexpr int kSteps = 11, kStride = 4, kHues = 180, kGreenest = 36, kGreenWidth = 50;
  const int index = static_cast<int>(reason);
  const int turned = index * kStride % kSteps * (kHues - kGreenWidth) / kSteps;
  const int hue = turned < kGreenest ? turned : turned + kGreenWidth;
  const int saturation = index <= kSteps ? 130 : 200;
  cv::Mat3b colour(1, 1, cv::Vec3b(static_cast<uchar>(hue), static_cast<uchar>(saturation), 255));
  cv::cvtColor(colour, colour, cv::COLOR_HSV2BGR);
  return cv::Scalar(colour(0, 0));
}

void drawDetection(const cv::Mat& image, const DetectionTrace& trace, const WindowObservation* window,
                   cv::Mat& canvas, std::optional<double> milliseconds) {
  if (image.type() != CV_8UC1 && image.type() != CV_8UC3) return;
  if (image.empty()) return;
  if (image.channels() == 1)
    cv::cvtColor(image, canvas, cv::COLOR_GRAY2BGR);
  else
    image.copyTo(canvas);
  canvas.convertTo(canvas, -1, kDim);
  drawCandidates(canvas, trace);
  if (window) window->whole() ? drawWhole(canvas, *window) : drawSides(canvas, *window);
  TextOverlay overlay(canvas);
  overlay.footer({summaryOf(trace, window, milliseconds), window ? kGreen : kYellow});
  if (window && window->whole()) overlay.keepFree(boxRound(window->corners));
  overlay.box(legendOf(trace));
  if (window && window->whole())
    overlay.label({cv::format("target, score %.2f", window->score), kGreen},
                  pixel(window->corners[geometry::kTopLeft]));
  explainBest(overlay, trace);
}

void drawYaw(cv::Mat& canvas, const WindowObservation& window, const std::string& text) {
  if (canvas.empty() || canvas.type() != CV_8UC3 || !window.whole() || !geometry::isFinite(window.corners))
    return;
  TextOverlay overlay(canvas);
  overlay.keepFree(boxRound(window.corners));
  overlay.label({text, kGreen}, pixel(window.corners[geometry::kBottomLeft]));
}

}  // namespace window_ingress::detection
