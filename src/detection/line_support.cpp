#include "window_ingress/detection/line_support.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr double kTwoPi = 6.283185307179586;
constexpr double kSameDirection = 0.996;  ///< cosine between pieces of one line
constexpr double kSameLinePx = 1.0;       ///< distance of their ends from the joint line

Vector2d perpendicular(const Vector2d& v) { return {-v.y(), v.x()}; }

}  // namespace

void joinCollinear(std::vector<Segment>& segments, double max_gap) {
  const std::size_t pieces = segments.size();
  for (std::size_t i = 0; i < pieces; ++i)
    for (std::size_t j = 0; j < pieces; ++j) {
      const Segment &p = segments[i], &q = segments[j];
      if (p.normal.dot(q.normal) < kSameDirection) continue;
      const Vector2d along = (p.b - p.a).normalized();
      const double gap = along.dot(q.a - p.b), lengths = p.length() + q.length();
      if (gap < 0.0 || gap > max_gap * lengths) continue;
      const Vector2d normal = perpendicular((q.b - p.a).normalized());
      if (std::abs(normal.dot(p.b - p.a)) > kSameLinePx || std::abs(normal.dot(q.a - p.a)) > kSameLinePx)
        continue;
      segments.push_back(
          {p.a, q.b, normal.dot(p.normal) < 0.0 ? Vector2d(-normal) : normal, p.pixels + q.pixels});
    }
}

void LineSupport::collect(const EdgeMap& map) {
  pixels_.clear();
  index_.create(map.edges.size(), CV_32SC1);
  index_.setTo(0);
  for (int y = 0; y < map.edges.rows; ++y) {
    const uchar* edge = map.edges.ptr<uchar>(y);
    for (int x = 0; x < map.edges.cols; ++x) {
      if (!edge[x]) continue;
      const double angle = std::atan2(map.dy.at<short>(y, x), map.dx.at<short>(y, x));
      const int bin = static_cast<int>(std::lround(angle * kAngles / kTwoPi) + kAngles) % kAngles;
      pixels_.push_back(
          {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), static_cast<std::int16_t>(bin), 0});
      index_.at<int>(y, x) = static_cast<int>(pixels_.size());
    }
  }
}

// Adds `step` to the cells of one pixel; the cell with most votes afterwards.
int LineSupport::vote(Pixel& pixel, int step) {
  int best = -1;
  for (int k = -spread_; k <= spread_; ++k) {
    const int angle = (pixel.angle + k + kAngles) % kAngles;
    const double rho = pixel.x * directions_[angle].x() + pixel.y * directions_[angle].y() + rho_offset_;
    const int cell = angle * rho_count_ + static_cast<int>(rho + 0.5);
    votes_[cell] = static_cast<std::uint16_t>(votes_[cell] + step);
    if (best < 0 || votes_[cell] > votes_[best]) best = cell;
  }
  return best;
}

LineSupport::Line LineSupport::seedLine(const Pixel& pixel, int cell) const {
  return {Vector2d(pixel.x, pixel.y), directions_[cell / rho_count_]};
}

// Unused edge pixel within one pixel of the line beside `at` and with a fitting gradient; -1 if there is
// none.
int LineSupport::pixelNear(const EdgeMap& map, const Line& line, const Vector2d& at) const {
  const double limit = std::cos(params_.direction_rad);
  for (double side : {0.0, 1.0, -1.0}) {
    const Vector2d p = at + side * line.normal;
    const int x = static_cast<int>(p.x() + 0.5), y = static_cast<int>(p.y() + 0.5);
    if (p.x() < 0.0 || p.y() < 0.0 || x < 0 || y < 0 || x >= map.edges.cols || y >= map.edges.rows) continue;
    const int i = index_.at<int>(y, x) - 1;
    if (i >= 0 && pixels_[i].state != 2 && directions_[pixels_[i].angle].dot(line.normal) > limit) return i;
  }
  return -1;
}

void LineSupport::walkOneWay(const EdgeMap& map, const Line& line, const Vector2d& start, double way) {
  Vector2d step = way * perpendicular(line.normal);
  step /= step.cwiseAbs().maxCoeff();
  Vector2d at = start - line.normal * line.normal.dot(start - line.point);
  for (double gap = 0.0; gap <= max_gap_px_ + 1.0; at += step, gap += 1.0) {
    const int i = pixelNear(map, line, at);
    if (i < 0) continue;
    gap = 0.0;
    if (found_.empty() || found_.back() != i) found_.push_back(i);
  }
}

void LineSupport::walk(const EdgeMap& map, const Line& line, const Vector2d& start) {
  found_.clear();
  walkOneWay(map, line, start, 1.0);
  walkOneWay(map, line, start, -1.0);
}

// Total least squares through the pixels found; false if they do not form a line.
bool LineSupport::fit(Line& line) const {
  if (found_.size() < 4) return false;
  Vector2d mean = Vector2d::Zero();
  for (int i : found_) mean += Vector2d(pixels_[i].x, pixels_[i].y);
  mean /= static_cast<double>(found_.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (int i : found_) {
    const Vector2d d = Vector2d(pixels_[i].x, pixels_[i].y) - mean;
    scatter += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(scatter);
  const Vector2d normal = solver.eigenvectors().col(0);
  line.point = mean;
  line.normal = normal.dot(line.normal) < 0.0 ? Vector2d(-normal) : normal;
  return true;
}

bool LineSupport::grow(const EdgeMap& map, const Pixel& seed, int cell, Segment& segment) {
  Line line = seedLine(seed, cell);
  const Vector2d start(seed.x, seed.y);
  for (int pass = 0; pass < 2; ++pass) {
    walk(map, line, start);
    if (!fit(line)) return false;
  }
  walk(map, line, start);
  if (found_.size() < 4) return false;
  const Vector2d along = perpendicular(line.normal);
  double low = 0.0, high = 0.0;
  for (int i : found_) {
    const double t = along.dot(Vector2d(pixels_[i].x, pixels_[i].y) - line.point);
    low = std::min(low, t);
    high = std::max(high, t);
  }
  segment = {line.point + high * along, line.point + low * along, line.normal,
             static_cast<int>(found_.size())};
  const double length = high - low, steps = length * along.cwiseAbs().maxCoeff();
  return length >= min_length_px_ && static_cast<double>(found_.size()) >= params_.min_density * steps;
}

std::vector<Segment> LineSupport::run(const EdgeMap& map) {
  collect(map);
  const double side = std::max(map.edges.cols, map.edges.rows);
  min_length_px_ = std::max(5.0, params_.min_length * side);
  max_gap_px_ = params_.max_gap * side;
  spread_ = static_cast<int>(std::ceil(params_.spread_rad * kAngles / kTwoPi));
  rho_offset_ = static_cast<int>(std::hypot(map.edges.cols, map.edges.rows)) + 1;
  rho_count_ = 2 * rho_offset_ + 1;
  votes_.assign(static_cast<std::size_t>(kAngles) * rho_count_, 0);
  for (int a = 0; a < kAngles; ++a)
    directions_[a] = Vector2d(std::cos(a * kTwoPi / kAngles), std::sin(a * kTwoPi / kAngles));

  order_.resize(pixels_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::mt19937 random(1);
  for (std::size_t i = order_.size(); i > 1; --i) std::swap(order_[i - 1], order_[random() % i]);

  std::vector<Segment> segments;
  const int threshold = std::max(4, static_cast<int>(params_.vote_fraction * min_length_px_));
  for (int i : order_) {
    Pixel& pixel = pixels_[i];
    if (pixel.state != 0) continue;
    pixel.state = 1;
    const int cell = vote(pixel, 1);
    if (votes_[cell] < threshold) continue;
    Segment segment;
    if (!grow(map, pixel, cell, segment)) continue;
    for (int j : found_) {
      if (pixels_[j].state == 1) vote(pixels_[j], -1);
      pixels_[j].state = 2;
    }
    segments.push_back(segment);
  }
  joinCollinear(segments, params_.join_gap);
  std::stable_sort(segments.begin(), segments.end(),
                   [](const Segment& a, const Segment& b) { return a.length() > b.length(); });
  if (static_cast<int>(segments.size()) > params_.max_segments) segments.resize(params_.max_segments);
  return segments;
}

}  // namespace window_ingress::detection
