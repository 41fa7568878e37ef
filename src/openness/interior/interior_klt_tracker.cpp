#include "window_ingress/openness/interior_klt_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "openness/interior/edge_klt.hpp"
#include "openness/interior/smooth_regions.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::openness {
namespace {

using detection::WindowObservation;
using geometry::Quadrilateral;

constexpr int kReach = 13, kLevels = 2;  // Lucas-Kanade: side of its patch [px], pyramid halvings
constexpr double kMinSide_px = 24.0;
constexpr double kMargin = 0.07;        // margin inside the border that is skipped [opening's sides]
constexpr double kMinContrast = 5e-5;   // of a corner: lesser eigenvalue of the gradient's moments
constexpr double kMinEdgeSlope = 3.0;   // [grey levels per pixel]
constexpr double kMaxReturn_px = 0.8;   // of a point tracked forward and back
constexpr double kFlowSigma_px = 0.35;  // of a tracked point
constexpr double kMaxGrowth = 1.25;     // of the window in the image, until the next keyframe
constexpr double kMaxKeyframeAge_sec = 4.0;
constexpr int kMinTracked = 6;       // with fewer left the next keyframe is taken
constexpr double kMinShared = 0.4;   // part of the keyframe's points that must be left
constexpr double kSpacing = 0.05;    // between points [longer sides of the rectified image]
constexpr double kMinAge_sec = 0.3;  // of a keyframe whose points were lost
constexpr int kGradientBlock = 5;
constexpr double kBlur_px = 0.8;  // against the noise of dark images

std::array<cv::Point2f, 4> toCv(const Quadrilateral& quad) {
  std::array<cv::Point2f, 4> points;
  for (int i = 0; i < 4; ++i) points[i] = {static_cast<float>(quad[i].x()), static_cast<float>(quad[i].y())};
  return points;
}

// Rectangle with the quadrilateral's mean side lengths, scaled down to `max_side_px`.
cv::Size rectifiedSize(const Quadrilateral& corners, double max_side_px) {
  const auto sides = geometry::sideLengths(corners);
  const double width = 0.5 * (sides[0] + sides[2]), height = 0.5 * (sides[1] + sides[3]);
  const double scale = std::min(1.0, max_side_px / std::max(width, height));
  return {static_cast<int>(std::lround(scale * width)), static_cast<int>(std::lround(scale * height))};
}

// Homography from the image to its rectified opening; the outermost pixels end at the opening's border.
cv::Matx33d rectification(const Quadrilateral& corners, const cv::Size& size) {
  const auto from = toCv(corners);
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

bool isUsable(const cv::Mat& image, const WindowObservation& window) {
  return !image.empty() && (image.type() == CV_8UC1 || image.type() == CV_8UC3) && window.whole() &&
         std::isfinite(window.stamp_sec) && geometry::isFinite(window.corners) &&
         geometry::isConvex(window.corners);
}

}  // namespace

struct InteriorKltTracker::Impl {
  struct Track {
    std::uint16_t id;
    cv::Point2f key, now;  // in the rectified images
    cv::Point2f normal;    // of an edge; zero for a corner
    bool isEdge() const { return normal.x != 0.0f || normal.y != 0.0f; }
  };

  explicit Impl(const InteriorKltParams& p) : params(p) {}

  void follow(const cv::Mat& image, WindowObservation& window) {
    const bool is_other = !has_key || window.target_id != target_id || !(window.stamp_sec > last_sec) ||
                          window.stamp_sec - tracks.key_stamp_sec > 2.0 * kMaxKeyframeAge_sec;
    last_sec = window.stamp_sec;
    if (is_other) return takeKey(image, window);
    rectify(image, window.corners);
    flow();
    report(window);
    if (isWornOut(window)) takeKey(image, window);
  }

  void takeKey(const cv::Mat& image, const WindowObservation& window) {
    has_key = false;
    size = rectifiedSize(window.corners, params.max_side_px);
    if (std::min(size.width, size.height) < kMinSide_px) return;
    if (image.channels() == 3) chooseChannel(image, window.corners);
    rectify(image, window.corners);
    cv::buildOpticalFlowPyramid(rectified, key_pyramid, {kReach, kReach}, kLevels, true);
    key_to_image = to_rectified.inv();
    key_scale = scaleOf(window.corners);
    tracks.key_stamp_sec = window.stamp_sec;
    tracks.key_corners = window.corners;
    tracks.key_covariance = window.corner_covariance;
    target_id = window.target_id;
    findPoints();
    found = points.size();
    has_key = true;
  }

  // Chooses the channel with the most edges: a brown cupboard before a blue wall may be as bright as the
  // wall.
  void chooseChannel(const cv::Mat& image, const Quadrilateral& corners) {
    int most = -1, best = 1;
    for (channel = 0; channel < 3; ++channel) {
      rectify(image, corners);
      slopes.take(rectified);
      const int steep = slopes.steeperThan(kMinEdgeSlope);
      if (steep > most) most = steep, best = channel;
    }
    channel = best;
  }

  void rectify(const cv::Mat& image, const Quadrilateral& corners) {
    to_rectified = rectification(corners, size);
    const cv::Rect part = cv::boundingRect(toCv(corners)) & cv::Rect(0, 0, image.cols, image.rows);
    if (part.empty()) {
      rectified = cv::Mat::zeros(size, CV_8UC1);
      return;
    }
    if (image.channels() == 3)
      cv::extractChannel(image(part), cut, channel);
    else
      cut = image(part);
    const cv::Matx33d from_part(1, 0, part.x, 0, 1, part.y, 0, 0, 1);
    cv::warpPerspective(cut, rectified, to_rectified * from_part, size, cv::INTER_LINEAR,
                        cv::BORDER_REPLICATE);
    cv::GaussianBlur(rectified, rectified, cv::Size(), kBlur_px);
  }

  /// Image pixels per rectified pixel.
  double scaleOf(const Quadrilateral& corners) const {
    return std::sqrt(geometry::signedArea(corners) / size.area());
  }

  // Finds the strongest corners and edges, spread out. Skips the margin, because it may show the reveal.
  void findPoints() {
    points.clear();
    cv::cornerMinEigenVal(rectified, contrast, kGradientBlock);
    const int longer = std::max(size.width, size.height);
    const int side = std::max(2, static_cast<int>(std::lround(kMargin * longer)));
    const cv::Rect inner(side, side, size.width - 2 * side, size.height - 2 * side);
    if (inner.width < kReach || inner.height < kReach) return;
    mask = cv::Mat::zeros(size, CV_8UC1);
    cv::compare(contrast(inner), kMinContrast, mask(inner), cv::CMP_GE);
    cv::goodFeaturesToTrack(rectified, from, params.max_points, 1e-3, std::max(4.0, kSpacing * longer), mask,
                            kGradientBlock);
    for (const cv::Point2f& p : from) points.push_back({static_cast<std::uint16_t>(points.size()), p, p, {}});
    rectified.copyTo(key_rectified);
    slopes.take(rectified);
    const int spacing = std::max(6, static_cast<int>(kSpacing * longer));
    for (const EdgePoint& edge :
         slopes.steepest(inner, spacing, kMinEdgeSlope, static_cast<std::size_t>(params.max_edges)))
      if (std::none_of(from.begin(), from.end(),
                       [&](const cv::Point2f& corner) { return lengthOf(corner - edge.place) < spacing; }))
        points.push_back({static_cast<std::uint16_t>(points.size()), edge.place, edge.place, edge.normal});
  }

  // Corners come first.
  void flow() {
    from.clear(), to.clear();
    for (const Track& track : points)
      if (!track.isEdge()) from.push_back(track.key), to.push_back(track.now);
    if (!from.empty()) flowCorners();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      Track track = points[i];
      if (i >= from.size() ? flowAcross(track) : isCornerBack(i)) {
        if (i < from.size()) track.now = to[i];
        points[kept++] = track;
      }
    }
    points.resize(kept);
  }

  void flowCorners() {
    back = from;
    const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 0.02);
    cv::buildOpticalFlowPyramid(rectified, pyramid, {kReach, kReach}, kLevels, true);
    cv::calcOpticalFlowPyrLK(key_pyramid, pyramid, from, to, there, error, {kReach, kReach}, kLevels, until,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    cv::calcOpticalFlowPyrLK(pyramid, key_pyramid, to, back, here, error, {kReach, kReach}, kLevels, until,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
  }

  bool isCornerBack(std::size_t i) const {
    return there[i] && here[i] && lengthOf(back[i] - from[i]) <= kMaxReturn_px && lies(to[i]);
  }

  bool flowAcross(Track& track) const {
    const auto now = followAcross(key_rectified, rectified, {track.key, track.normal}, track.now);
    if (!now || !lies(*now)) return false;
    const auto again = followAcross(rectified, key_rectified, {*now, track.normal}, track.key);
    if (!again || lengthOf(*again - track.key) > kMaxReturn_px) return false;
    track.now = *now;
    return true;
  }

  bool lies(const cv::Point2f& p) const {
    const float side = static_cast<float>(0.5 * kMargin * std::max(size.width, size.height));
    return p.x >= side && p.y >= side && p.x <= static_cast<float>(size.width) - 1.0f - side &&
           p.y <= static_cast<float>(size.height) - 1.0f - side;
  }

  void report(WindowObservation& window) {
    const cv::Matx33d to_image = to_rectified.inv();
    tracks.sigma_px = kFlowSigma_px * std::max(scaleOf(window.corners), 1.0);
    tracks.points.clear();
    regions.find(rectified, params.surface_slope);
    for (const Track& track : points) {
      const Eigen::Vector2d now = mapped(to_image, track.now);
      Eigen::Vector2d normal = Eigen::Vector2d::Zero();
      if (track.isEdge()) {
        const cv::Point2f beside = track.now + cv::Point2f(-track.normal.y, track.normal.x);
        const Eigen::Vector2d along = (mapped(to_image, beside) - now).normalized();
        normal = {along.y(), -along.x()};
      }
      tracks.points.push_back(
          {track.id, mapped(key_to_image, track.key), now, normal, regions.cellsBeside(track.now)});
    }
    window.interior = tracks;
  }

  bool isWornOut(const WindowObservation& window) const {
    const double growth = scaleOf(window.corners) / key_scale,
                 age_sec = window.stamp_sec - tracks.key_stamp_sec;
    const double left = static_cast<double>(points.size());
    return growth > kMaxGrowth || growth < 1.0 / kMaxGrowth || age_sec > kMaxKeyframeAge_sec ||
           (age_sec > kMinAge_sec && (left < kMinTracked || left < kMinShared * static_cast<double>(found)));
  }

  InteriorKltParams params;
  bool has_key = false;
  std::uint32_t target_id = 0;
  double last_sec = 0.0;
  int channel = 1;           // channel of the image that is used
  cv::Size size;             // of the rectified images
  double key_scale = 1.0;    // keyframe pixels per rectified pixel
  cv::Matx33d to_rectified;  // of the last image
  cv::Matx33d key_to_image;
  cv::Mat cut, rectified, key_rectified, mask, contrast;
  SlopeImage slopes;
  SmoothRegions regions;
  std::vector<cv::Mat> key_pyramid, pyramid;
  std::vector<Track> points;
  std::size_t found = 0;
  std::vector<cv::Point2f> from, to, back;
  std::vector<unsigned char> there, here;
  std::vector<float> error;
  detection::InteriorTracks tracks;
};

InteriorKltTracker::InteriorKltTracker(const InteriorKltParams& params)
    : impl_(std::make_unique<Impl>(parameters::requireInRange(params, "openness"))) {}
InteriorKltTracker::~InteriorKltTracker() = default;

void InteriorKltTracker::reset() { impl_->has_key = false; }

void InteriorKltTracker::follow(const cv::Mat& image, WindowObservation& window) {
  window.interior.points.clear();
  if (impl_->params.enabled && isUsable(image, window)) impl_->follow(image, window);
}

}  // namespace window_ingress::openness
