#include "window_ingress/openness/interior_follower.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <stdexcept>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::openness {
namespace {

using detection::WindowObservation;
using geometry::Quadrilateral;

constexpr int kReach = 13, kLevels = 2;  // of Lucas-Kanade: side of its patch [px], further halvings
constexpr double kLeastSide_px = 24.0;
constexpr double kSpacing = 0.05;  // between points, part of the straightened picture's longer side
constexpr int kGradientBlock = 5;
constexpr double kBlur_px = 0.8;  // against the noise of dark pictures

cv::Point2f toCv(const Eigen::Vector2d& p) { return {static_cast<float>(p.x()), static_cast<float>(p.y())}; }

// The rectangle whose sides are as long as the quadrilateral's in the mean, scaled down to `most_px`.
cv::Size straightenedSize(const Quadrilateral& corners, double most_px) {
  const auto sides = geometry::sideLengths(corners);
  const double width = 0.5 * (sides[0] + sides[2]), height = 0.5 * (sides[1] + sides[3]);
  const double scale = std::min(1.0, most_px / std::max(width, height));
  return {static_cast<int>(std::lround(scale * width)), static_cast<int>(std::lround(scale * height))};
}

// From the picture to its straightened opening; outer borders of the outermost pixels lie on the opening's.
cv::Matx33d straightening(const Quadrilateral& corners, const cv::Size& size) {
  const std::array<cv::Point2f, 4> from{toCv(corners[0]), toCv(corners[1]), toCv(corners[2]),
                                        toCv(corners[3])};
  const float right = static_cast<float>(size.width) - 0.5f, bottom = static_cast<float>(size.height) - 0.5f;
  const std::array<cv::Point2f, 4> to{cv::Point2f(-0.5f, -0.5f), cv::Point2f(right, -0.5f),
                                      cv::Point2f(right, bottom), cv::Point2f(-0.5f, bottom)};
  return cv::getPerspectiveTransform(from.data(), to.data());
}

Eigen::Vector2d mapped(const cv::Matx33d& H, const cv::Point2f& p) {
  const cv::Vec3d q = H * cv::Vec3d(p.x, p.y, 1.0);
  return {q[0] / q[2], q[1] / q[2]};
}

double lengthOf(const cv::Point2f& way) { return std::hypot(way.x, way.y); }

bool isUsable(const WindowObservation& window) {
  return window.whole() && std::isfinite(window.stamp_sec) && geometry::isFinite(window.corners) &&
         geometry::isConvex(window.corners);
}

}  // namespace

struct InteriorFollower::Impl {
  struct Track {
    std::uint16_t id;
    cv::Point2f key, now;  // in the straightened pictures
  };

  explicit Impl(const FollowerParams& p) : params(p) {}

  bool isOther(const WindowObservation& window) const {
    return !has_key || window.target_id != target_id || !(window.stamp_sec > last_sec) ||
           window.stamp_sec - tracks.key_stamp_sec > 2.0 * params.max_key_age_sec;
  }
  void straighten(const cv::Mat& image, const Quadrilateral& corners);
  void takeKey(const cv::Mat& image, const WindowObservation& window);
  void findPoints();
  void flow();
  bool lies(const cv::Point2f& p) const;
  void report(WindowObservation& window);
  bool isWornOut(const WindowObservation& window) const;

  FollowerParams params;
  bool has_key = false;
  std::uint32_t target_id = 0;
  double last_sec = 0.0;
  cv::Size size;            // of the straightened pictures
  double key_scale = 1.0;   // pixels of the key picture a straightened one
  cv::Matx33d to_straight;  // of the picture looked at last
  cv::Matx33d key_to_picture;
  cv::Mat cut, straight, mask, contrast;
  std::vector<cv::Mat> key_pyramid, pyramid;
  std::vector<Track> points;
  std::size_t found = 0;
  std::vector<cv::Point2f> from, to, back;
  std::vector<unsigned char> there, here;
  std::vector<float> error;
  detection::InteriorTracks tracks;
};

void InteriorFollower::Impl::straighten(const cv::Mat& image, const Quadrilateral& corners) {
  to_straight = straightening(corners, size);
  cv::warpPerspective(image, cut, to_straight, size, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  if (cut.channels() == 3)
    cv::cvtColor(cut, straight, cv::COLOR_BGR2GRAY);
  else
    cut.copyTo(straight);
  cv::GaussianBlur(straight, straight, cv::Size(), kBlur_px);
}

void InteriorFollower::Impl::takeKey(const cv::Mat& image, const WindowObservation& window) {
  has_key = false;
  size = straightenedSize(window.corners, params.most_px);
  if (std::min(size.width, size.height) < kLeastSide_px) return;
  straighten(image, window.corners);
  cv::buildOpticalFlowPyramid(straight, key_pyramid, {kReach, kReach}, kLevels, true);
  key_to_picture = to_straight.inv();
  key_scale = std::sqrt(geometry::signedArea(window.corners) / size.area());
  tracks.key_stamp_sec = window.stamp_sec;
  tracks.key_corners = window.corners;
  tracks.key_covariance = window.corner_covariance;
  target_id = window.target_id;
  findPoints();
  found = points.size();
  has_key = true;
}

// The strongest corners, each some way from the others; what the margin shows may be the reveal.
void InteriorFollower::Impl::findPoints() {
  points.clear();
  cv::cornerMinEigenVal(straight, contrast, kGradientBlock);
  const int side =
      std::max(2, static_cast<int>(std::lround(params.margin * std::max(size.width, size.height))));
  const cv::Rect inner(side, side, size.width - 2 * side, size.height - 2 * side);
  if (inner.width < kReach || inner.height < kReach) return;
  mask = cv::Mat::zeros(size, CV_8UC1);
  for (int y = inner.y; y < inner.y + inner.height; ++y)
    for (int x = inner.x; x < inner.x + inner.width; ++x)
      mask.at<unsigned char>(y, x) = contrast.at<float>(y, x) >= params.min_contrast ? 255 : 0;
  cv::goodFeaturesToTrack(straight, from, params.max_points, 1e-3,
                          std::max(4.0, kSpacing * std::max(size.width, size.height)), mask, kGradientBlock);
  for (const cv::Point2f& p : from) points.push_back({static_cast<std::uint16_t>(points.size()), p, p});
}

bool InteriorFollower::Impl::lies(const cv::Point2f& p) const {
  const float side = static_cast<float>(0.5 * params.margin * std::max(size.width, size.height));
  return p.x >= side && p.y >= side && p.x <= static_cast<float>(size.width) - 1.0f - side &&
         p.y <= static_cast<float>(size.height) - 1.0f - side;
}

void InteriorFollower::Impl::flow() {
  from.clear(), to.clear();
  for (const Track& track : points) from.push_back(track.key), to.push_back(track.now);
  back = from;
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 0.02);
  cv::buildOpticalFlowPyramid(straight, pyramid, {kReach, kReach}, kLevels, true);
  cv::calcOpticalFlowPyrLK(key_pyramid, pyramid, from, to, there, error, {kReach, kReach}, kLevels, until,
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  cv::calcOpticalFlowPyrLK(pyramid, key_pyramid, to, back, here, error, {kReach, kReach}, kLevels, until,
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!there[i] || !here[i] || lengthOf(back[i] - from[i]) > params.max_return_px || !lies(to[i])) continue;
    points[kept] = points[i];
    points[kept++].now = to[i];
  }
  points.resize(kept);
}

void InteriorFollower::Impl::report(WindowObservation& window) {
  const cv::Matx33d to_picture = to_straight.inv();
  const double scale = std::sqrt(geometry::signedArea(window.corners) / size.area());
  tracks.sigma_px = params.flow_sigma_px * std::max(scale, 1.0);
  tracks.points.clear();
  for (const Track& track : points)
    tracks.points.push_back({track.id, mapped(key_to_picture, track.key), mapped(to_picture, track.now)});
  window.interior = tracks;
}

bool InteriorFollower::Impl::isWornOut(const WindowObservation& window) const {
  const double growth = std::sqrt(geometry::signedArea(window.corners) / size.area()) / key_scale;
  const double left = static_cast<double>(points.size());
  return growth > params.max_growth || growth < 1.0 / params.max_growth ||
         window.stamp_sec - tracks.key_stamp_sec > params.max_key_age_sec || left < params.min_points ||
         left < params.min_shared * static_cast<double>(found);
}

InteriorFollower::InteriorFollower(const FollowerParams& params) : impl_(std::make_unique<Impl>(params)) {
  const auto faults = parameters::outOfRange(params);
  if (!faults.empty()) throw std::invalid_argument("openness: " + parameters::joined(faults));
}
InteriorFollower::~InteriorFollower() = default;
InteriorFollower::InteriorFollower(InteriorFollower&&) noexcept = default;
InteriorFollower& InteriorFollower::operator=(InteriorFollower&&) noexcept = default;

void InteriorFollower::reset() { impl_->has_key = false; }

void InteriorFollower::follow(const cv::Mat& image, WindowObservation& window) {
  window.interior.points.clear();
  if (!impl_->params.enabled || !isUsable(window)) return;
  if (image.empty() || (image.type() != CV_8UC1 && image.type() != CV_8UC3)) return;
  const bool is_other = impl_->isOther(window);
  impl_->last_sec = window.stamp_sec;
  if (is_other) return impl_->takeKey(image, window);
  impl_->straighten(image, window.corners);
  if (!impl_->points.empty()) impl_->flow();
  impl_->report(window);
  if (impl_->isWornOut(window)) impl_->takeKey(image, window);
}

}  // namespace window_ingress::openness
