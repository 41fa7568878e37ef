#include "detection/alignment/ring_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "detection/quad_sameness.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kSidePx = 14.0;                          ///< of the pattern [px per mean side]
constexpr int kReach = 3;                                 ///< of the pattern beyond the opening [px]
constexpr int kFine = 8;                                  ///< pixels averaged in each direction
constexpr double kSmallestPx = 40.0, kLargestPart = 0.8;  ///< mean side [px] and [shorter image sides]
constexpr double kStep = 1.3;                             ///< factor between sizes
constexpr float kLeast = 0.25F;                           ///< correlation of a place
constexpr double kSlopeNoise = 0.02;                      ///< of a slope of a logarithm [1/px]
constexpr int kFewestShown = 3;                           ///< sides that the reference must show
constexpr int kPeakPx = 5;
constexpr int kFurthestPx = 2;     ///< offset of half a side across it
constexpr double kOffCost = 0.02;  ///< subtracted from the likeness per pixel of offset

// The part round the opening that the reference shows.
cv::Rect shownAbout(const cv::Rect& opening, const cv::Mat& is_shown) {
  const auto shows = [&](const cv::Rect& part) { return cv::countNonZero(is_shown(part) < 255) == 0; };
  cv::Rect shown = opening;
  for (int n = 0; n < kReach; ++n) {
    if (shows({shown.x - 1, shown.y, 1, shown.height})) --shown.x, ++shown.width;
    if (shows({shown.x, shown.y - 1, shown.width, 1})) --shown.y, ++shown.height;
    if (shows({shown.br().x, shown.y, 1, shown.height})) ++shown.width;
    if (shows({shown.x, shown.br().y, shown.width, 1})) ++shown.height;
  }
  return shown;
}

double squaresOf(const cv::Mat& x, const cv::Mat& y) {
  return cv::norm(x, cv::NORM_L2SQR) + cv::norm(y, cv::NORM_L2SQR);
}

}  // namespace

// Slopes of the logarithms, which do not depend on the strength of the light.
void RingSearch::readSlopes(const cv::Mat& grey) {
  static const cv::Mat logs(1, 256, CV_32F, const_cast<float*>(kLogsOfColours.data()));
  cv::LUT(grey, logs, logs_);
  cv::Sobel(logs_, slopes_x_, CV_32F, 1, 0, 1, 0.5, 0.0, cv::BORDER_REPLICATE);
  cv::Sobel(logs_, slopes_y_, CV_32F, 0, 1, 1, 0.5, 0.0, cv::BORDER_REPLICATE);
}

void RingSearch::learn(const cv::Mat& image, const geometry::Quadrilateral& opening) {
  sides_.clear();
  const double aspect = geometry::aspectRatio(opening);
  opening_.width = kSidePx * 2.0 * aspect / (1.0 + aspect), opening_.height = kSidePx * 2.0 / (1.0 + aspect);
  const auto width = static_cast<float>(opening_.width), height = static_cast<float>(opening_.height);
  pattern_ = {2 * kReach + cvRound(width), 2 * kReach + cvRound(height)};
  opening_.x = 0.5 * (pattern_.width - opening_.width),
  opening_.y = 0.5 * (pattern_.height - opening_.height);
  const auto left = 0.5F * (static_cast<float>(pattern_.width) - width),
             top = 0.5F * (static_cast<float>(pattern_.height) - height);
  std::array<cv::Point2f, 4> from,
      to{{{left, top}, {left + width, top}, {left + width, top + height}, {left, top + height}}};
  for (int i = 0; i < 4; ++i) {
    from[i] = {static_cast<float>(opening[i].x()), static_cast<float>(opening[i].y())};
    to[i] = to[i] * kFine - cv::Point2f(0.5F, 0.5F);
  }
  const cv::Mat map = cv::getPerspectiveTransform(from.data(), to.data());
  const cv::Size fine = pattern_ * kFine;
  cv::Mat shown, grey, is_shown;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  cv::warpPerspective(grey, shown, map, fine, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::warpPerspective(cv::Mat(image.size(), CV_8U, cv::Scalar(255)), is_shown, map, fine, cv::INTER_NEAREST);
  cv::resize(shown, shown, pattern_, 0, 0, cv::INTER_AREA);
  cv::resize(is_shown, is_shown, pattern_, 0, 0, cv::INTER_AREA);
  readSlopes(shown);
  const cv::Rect inner(kReach, kReach, pattern_.width - 2 * kReach, pattern_.height - 2 * kReach);
  const cv::Rect seen = shownAbout(inner, is_shown);
  const cv::Point end = inner.br();
  for (const cv::Rect& beside :
       {cv::Rect(0, 0, pattern_.width, kReach), cv::Rect(end.x, 0, kReach, pattern_.height),
        cv::Rect(0, end.y, pattern_.width, kReach), cv::Rect(0, 0, kReach, pattern_.height)})
    if (const cv::Rect at = beside & seen; at.area() > 0)
      sides_.push_back({at, slopes_x_(at).clone(), slopes_y_(at).clone(), beside.width > beside.height});
  if (sides_.size() < kFewestShown) sides_.clear();
}

// Computes the slopes at this size of the image; false if it is smaller than the pattern.
bool RingSearch::shrink(double factor) {
  const cv::Size full = pyramid_.level(0).size();
  const cv::Size size(static_cast<int>(full.width * factor), static_cast<int>(full.height * factor));
  if (size.width < pattern_.width || size.height < pattern_.height) return false;
  const int k = std::max(0, static_cast<int>(std::floor(-std::log2(factor))));
  cv::resize(pyramid_.level(k), level_, size, 0, 0, cv::INTER_AREA);
  readSlopes(level_);
  return true;
}

// Correlates this size of the image with the pattern, at every place. For such small sides, direct sums are
// faster than Fourier transforms.
bool RingSearch::correlate(double factor) {
  if (!shrink(factor)) return false;
  const cv::Size places(level_.cols - pattern_.width + 1, level_.rows - pattern_.height + 1);
  squares_ = slopes_x_.mul(slopes_x_) + slopes_y_.mul(slopes_y_);
  sum_ = cv::Mat::zeros(places, CV_32F);
  for (const Side& side : sides_) {
    cv::filter2D(slopes_x_, alike_, CV_32F, side.slopes_x, {0, 0});
    cv::filter2D(slopes_y_, alike_y_, CV_32F, side.slopes_y, {0, 0});
    alike_ += alike_y_;
    cv::boxFilter(squares_, norm_, CV_32F, side.at.size(), {0, 0}, false);
    const double noise = kSlopeNoise * kSlopeNoise * 2.0 * side.at.area();
    norm_ = (norm_ + noise) * (squaresOf(side.slopes_x, side.slopes_y) + noise);
    cv::sqrt(norm_, norm_);
    cv::divide(alike_, norm_, alike_);
    cv::dilate(alike_, alike_, cv::Mat());
    sum_ += alike_(cv::Rect(side.at.tl(), places));
  }
  sum_ *= 1.0 / static_cast<double>(sides_.size());
  return true;
}

void RingSearch::takePeaks(double factor) {
  cv::dilate(sum_, peaks_, cv::Mat::ones(kPeakPx, kPeakPx, CV_8U));
  const auto in_image = [factor](double x, double y) {
    return Eigen::Vector2d(x / factor - 0.5, y / factor - 0.5);
  };
  for (int row = 0; row < sum_.rows; ++row)
    for (int column = 0; column < sum_.cols; ++column) {
      const float value = sum_.at<float>(row, column);
      if (value < kLeast || value < peaks_.at<float>(row, column)) continue;
      const double left = column + opening_.x, right = left + opening_.width;
      const double top = row + opening_.y, bottom = top + opening_.height;
      const geometry::Quadrilateral quad = {in_image(left, top), in_image(right, top),
                                            in_image(right, bottom), in_image(left, bottom)};
      places_.push_back({quad, value, factor, {column, row}});
    }
}

// Correlation of a part of a side with the image there.
double RingSearch::likeness(const Side& side, const cv::Rect& part, const cv::Point& at) const {
  const cv::Rect there = part + at;
  if ((there & cv::Rect({0, 0}, slopes_x_.size())) != there) return -1.0;
  const cv::Mat x = slopes_x_(there), y = slopes_y_(there);
  const cv::Mat wanted_x = side.slopes_x(part), wanted_y = side.slopes_y(part);
  const double noise = 2.0 * kSlopeNoise * kSlopeNoise * part.area();
  return (wanted_x.dot(x) + wanted_y.dot(y)) /
         std::sqrt((squaresOf(x, y) + noise) * (squaresOf(wanted_x, wanted_y) + noise));
}

// Offset across a part of a side at its best fit, between pixels by a parabola.
double RingSearch::offAcross(const Side& side, const cv::Rect& part, const cv::Point& at) const {
  std::array<double, 2 * kFurthestPx + 1> alike{};
  for (int across = -kFurthestPx; across <= kFurthestPx; ++across) {
    double best = -1.0;
    for (int along = -1; along <= 1; ++along) {
      const cv::Point off = side.is_level ? cv::Point(along, across) : cv::Point(across, along);
      best = std::max(best, likeness(side, part, at + off));
    }
    alike[across + kFurthestPx] = best - kOffCost * std::abs(across);
  }
  const auto most = std::max_element(alike.begin(), alike.end());
  const auto off = static_cast<double>(most - alike.begin()) - kFurthestPx;
  if (most == alike.begin() || most + 1 == alike.end()) return off;
  const double bend = most[-1] - 2.0 * most[0] + most[1];
  return bend < 0.0 ? off + 0.5 * (most[-1] - most[1]) / bend : off;
}

// Line through the middles of the side's halves, each at its best fit.
RingSearch::Line RingSearch::settled(const Side& side, const cv::Point& at) const {
  const int length = side.is_level ? side.at.width : side.at.height, half = length / 2;
  std::array<double, 2> off{}, middle{};
  for (int h = 0; h < 2; ++h) {
    const int begin = h * half, size = h == 0 ? half : length - half;
    const cv::Rect part =
        side.is_level ? cv::Rect(begin, 0, size, side.at.height) : cv::Rect(0, begin, side.at.width, size);
    off[h] = offAcross(side, part, at + side.at.tl());
    middle[h] = (side.is_level ? side.at.x : side.at.y) + begin + 0.5 * size;
  }
  const double slope = (off[1] - off[0]) / (middle[1] - middle[0]);
  return {off[0] - slope * middle[0], slope};
}

// Moves the four sides of a place to their best fit.
void RingSearch::settle(Place& place) {
  if (sides_.size() != 4 || !shrink(place.factor)) return;
  std::array<Line, 4> lines;
  for (int i = 0; i < 4; ++i) lines[i] = settled(sides_[i], place.at);
  lines[0].at0 += opening_.y, lines[2].at0 += opening_.y + opening_.height;
  lines[3].at0 += opening_.x, lines[1].at0 += opening_.x + opening_.width;
  const auto corner = [&](const Line& level, const Line& upright) {
    const double x = (upright.slope * level.at0 + upright.at0) / (1.0 - upright.slope * level.slope);
    const Eigen::Vector2d in_pattern(x, level.slope * x + level.at0);
    return Eigen::Vector2d((in_pattern + Eigen::Vector2d(place.at.x, place.at.y)) / place.factor -
                           Eigen::Vector2d(0.5, 0.5));
  };
  const geometry::Quadrilateral quad = {corner(lines[0], lines[3]), corner(lines[0], lines[1]),
                                        corner(lines[2], lines[1]), corner(lines[2], lines[3])};
  if (geometry::isFinite(quad) && geometry::isConvex(quad)) place.quad = quad;
}

const std::vector<RingSearch::Place>& RingSearch::run(const cv::Mat& image, std::size_t most, bool leaning) {
  places_.clear();
  if (sides_.empty()) return places_;
  cv::cvtColor(image, grey_, cv::COLOR_BGR2GRAY);
  pyramid_.set(grey_);
  const double largest = kLargestPart * std::min(image.cols, image.rows);
  for (double side_px = kSmallestPx; side_px < largest; side_px *= kStep)
    if (const double factor = kSidePx / side_px; correlate(factor)) takePeaks(factor);
  std::stable_sort(places_.begin(), places_.end(),
                   [](const Place& a, const Place& b) { return a.correlation > b.correlation; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < places_.size() && kept < most; ++i) {
    const auto end = places_.begin() + static_cast<std::ptrdiff_t>(kept);
    if (std::none_of(places_.begin(), end,
                     [&](const Place& p) { return Sameness(p.quad).samePlace(places_[i].quad); }))
      places_[kept++] = places_[i];
  }
  places_.resize(kept);
  if (leaning)
    for (Place& place : places_) settle(place);
  return places_;
}

}  // namespace window_ingress::detection
