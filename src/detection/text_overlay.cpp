#include "window_ingress/detection/text_overlay.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace window_ingress::detection {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kShade = 0.35;   ///< part of the background brightness behind text
constexpr double kRoom = 1.7;     ///< height of a line [letter heights]
constexpr double kBoxPart = 0.6;  ///< height of a box, at most [canvas heights]
const cv::Scalar kWhite(255, 255, 255);

}  // namespace

TextOverlay::TextOverlay(cv::Mat& canvas)
    : canvas_(canvas), scale_(std::clamp(std::min(canvas.cols / 1700.0, canvas.rows / 1200.0), 0.28, 3.0)) {
  height_ = static_cast<int>(std::lround(kRoom * sizeOf("0g").height));
}

cv::Size TextOverlay::sizeOf(const std::string& text) const {
  int baseline = 0;
  const cv::Size size = cv::getTextSize(text, kFont, scale_, 1, &baseline);
  return {size.width, size.height + baseline / 2};
}

void TextOverlay::backdrop(const cv::Rect& area) {
  const cv::Rect seen = area & cv::Rect({0, 0}, canvas_.size());
  if (seen.empty()) return;
  cv::Mat part = canvas_(seen);
  part.convertTo(part, -1, kShade);
  taken_.push_back(area);
}

void TextOverlay::write(const std::string& text, const cv::Point& baseline, const cv::Scalar& colour) {
  const int thickness = scale_ > 0.9 ? 2 : 1;
  cv::putText(canvas_, text, baseline, kFont, scale_, colour, thickness, cv::LINE_AA);
}

bool TextOverlay::isFree(const cv::Rect& area) const {
  if ((area & cv::Rect({0, 0}, canvas_.size())) != area) return false;
  return std::none_of(taken_.begin(), taken_.end(),
                      [&](const cv::Rect& other) { return !(area & other).empty(); });
}

cv::Point TextOverlay::freeCorner(const cv::Size& size) const {
  const int right = canvas_.cols - size.width, low = canvas_.rows - height_ * 5 / 4 - size.height;
  for (const cv::Point& corner :
       {cv::Point(0, 0), cv::Point(right, 0), cv::Point(0, low), cv::Point(right, low)})
    if (isFree({corner, size})) return corner;
  return {0, 0};
}

void TextOverlay::box(const std::vector<Line>& lines) {
  const int fitting = std::max(1, static_cast<int>(kBoxPart * canvas_.rows) / height_);
  const int count = std::min(fitting, static_cast<int>(lines.size())), margin = height_ / 2;
  if (count == 0) return;
  int width = 0;
  for (int i = 0; i < count; ++i) width = std::max(width, sizeOf(lines[i].text).width + height_);
  const cv::Rect area({0, 0}, cv::Size(width + 2 * margin, count * height_ + margin));
  const cv::Point corner = freeCorner(area.size());
  backdrop(area + corner);
  for (int i = 0; i < count; ++i) {
    const cv::Point baseline = corner + cv::Point(margin, (i + 1) * height_);
    const int side = height_ / 2;
    cv::rectangle(canvas_, {baseline.x, baseline.y - side, side, side}, lines[i].colour, cv::FILLED);
    write(lines[i].text, baseline + cv::Point(height_, 0), kWhite);
  }
}

void TextOverlay::keepFree(const cv::Rect& area) {
  if (3 * area.width < 2 * canvas_.cols && 3 * area.height < 2 * canvas_.rows) taken_.push_back(area);
}

void TextOverlay::footer(const Line& line) {
  backdrop({0, canvas_.rows - height_ * 5 / 4, canvas_.cols, height_ * 5 / 4});
  write(line.text, {height_ / 2, canvas_.rows - height_ * 2 / 5}, line.colour);
}

bool TextOverlay::label(const Line& line, const cv::Point& at) {
  const cv::Size size = sizeOf(line.text);
  const int w = size.width + height_ / 2, h = height_, gap = 2;
  const cv::Point places[] = {{at.x, at.y - h - gap}, {at.x, at.y + gap},         {at.x - w, at.y - h - gap},
                              {at.x - w, at.y + gap}, {at.x, at.y - 2 * h - gap}, {at.x, at.y + h + gap}};
  for (const cv::Point& place : places) {
    const cv::Rect area(place, cv::Size(w, h));
    if (!isFree(area)) continue;
    backdrop(area);
    write(line.text, {place.x + height_ / 4, place.y + height_ * 7 / 10}, line.colour);
    return true;
  }
  return false;
}

void drawQuad(cv::Mat& canvas, const geometry::Quadrilateral& quad, const cv::Scalar& colour, int thickness) {
  constexpr int kShift = 4;
  std::array<cv::Point, 4> points;
  for (int i = 0; i < 4; ++i) {
    if (!quad[i].allFinite() || quad[i].cwiseAbs().maxCoeff() > 30000.0) return;
    points[i] = {static_cast<int>(std::lround(quad[i].x() * (1 << kShift))),
                 static_cast<int>(std::lround(quad[i].y() * (1 << kShift)))};
  }
  const cv::Point* const first = points.data();
  const int count = 4;
  cv::polylines(canvas, &first, &count, 1, true, colour, thickness, cv::LINE_AA, kShift);
}

}  // namespace window_ingress::detection
