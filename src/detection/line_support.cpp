#include "window_ingress/detection/line_support.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <utility>

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr double kTwoPi = 6.283185307179586;
constexpr double kSameDirection = 0.996;  ///< cosine between pieces of one line
constexpr double kSameLinePx = 1.0;       ///< distance of their ends from the joint line

Vector2d perpendicular(const Vector2d& v) { return {-v.y(), v.x()}; }

/// What `joinCollinear` asks of a piece again and again.
struct Piece {
  Vector2d along;
  double length;
};

std::vector<Piece> measured(const std::vector<Segment>& segments) {
  std::vector<Piece> pieces;
  pieces.reserve(segments.size());
  for (const Segment& s : segments) pieces.push_back({(s.b - s.a).normalized(), s.length()});
  return pieces;
}

void keepLongest(std::vector<Segment>& segments, int count) {
  std::vector<std::pair<double, int>> order;
  order.reserve(segments.size());
  for (const Segment& s : segments) order.emplace_back(-s.length(), static_cast<int>(order.size()));
  std::sort(order.begin(), order.end());
  order.resize(std::min<std::size_t>(order.size(), count));
  std::vector<Segment> longest;
  longest.reserve(order.size());
  for (const auto& [length, i] : order) longest.push_back(segments[i]);
  segments.swap(longest);
}

}  // namespace

void joinCollinear(std::vector<Segment>& segments, double max_gap) {
  const std::vector<Piece> pieces = measured(segments);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t j = 0; j < pieces.size(); ++j) {
      const Segment &p = segments[i], &q = segments[j];
      if (p.normal.dot(q.normal) < kSameDirection) continue;
      const double gap = pieces[i].along.dot(q.a - p.b), lengths = pieces[i].length + pieces[j].length;
      if (gap < 0.0 || gap > max_gap * lengths) continue;
      const Vector2d normal = perpendicular((q.b - p.a).normalized());
      if (std::abs(normal.dot(p.b - p.a)) > kSameLinePx || std::abs(normal.dot(q.a - p.a)) > kSameLinePx)
        continue;
      segments.push_back(
          {p.a, q.b, normal.dot(p.normal) < 0.0 ? Vector2d(-normal) : normal, p.pixels + q.pixels});
    }
}

LineSupport::LineSupport(const LineSupportParams& params)
    : params_(params),
      min_cosine_(std::cos(params.direction_rad)),
      spread_(static_cast<int>(std::ceil(params.spread_rad * kAngles / kTwoPi))) {}

void LineSupport::prepare(const EdgeMap& map) {
  const double side = std::max(map.edges.cols, map.edges.rows);
  min_length_px_ = std::max(5.0, params_.min_length * side);
  max_gap_px_ = params_.max_gap * side;
  rho_offset_ = static_cast<int>(std::hypot(map.edges.cols, map.edges.rows)) + 1;
  rho_count_ = 2 * rho_offset_ + 1;
  votes_.resize(static_cast<std::size_t>(kAngles) * rho_count_);
  std::memset(votes_.data(), 0, votes_.size() * sizeof votes_[0]);
  collect(map);
  markSurroundings();
  shuffle();
}

void LineSupport::collect(const EdgeMap& map) {
  pixels_.clear();
  index_.create(map.edges.size(), CV_32SC1);
  index_.setTo(0);
  for (int y = 0; y < map.edges.rows; ++y) {
    const uchar* edge = map.edges.ptr<uchar>(y);
    const short *dx = map.dx.ptr<short>(y), *dy = map.dy.ptr<short>(y);
    int* index = index_.ptr<int>(y);
    for (int x = 0; x < map.edges.cols; ++x) {
      if (!edge[x]) continue;
      pixels_.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y),
                         static_cast<std::int16_t>(bins_.of(dx[x], dy[x])), 0});
      index[x] = static_cast<int>(pixels_.size());
    }
  }
}

void LineSupport::markSurroundings() {
  surroundings_.create(index_.rows + 2, index_.cols + 2, CV_32SC1);
  surroundings_.setTo(0);
  for (const Pixel& pixel : pixels_) {
    const std::uint32_t sector = 1U << (pixel.angle * kSectors / kAngles);
    for (int y = pixel.y; y <= pixel.y + 2; ++y) {
      auto* row = surroundings_.ptr<std::uint32_t>(y) + pixel.x;
      for (int x = 0; x <= 2; ++x) row[x] |= sector;
    }
  }
}

void LineSupport::shuffle() {
  order_.resize(pixels_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::mt19937 random(1);
  for (std::size_t i = order_.size(); i > 1; --i)
    std::swap(order_[i - 1], order_[static_cast<std::uint32_t>(random()) % static_cast<std::uint32_t>(i)]);
}

inline int LineSupport::cellOf(const Pixel& pixel, int angle) const {
  const Vector2d& normal = bins_.direction(angle);
  const double rho = pixel.x * normal.x() + pixel.y * normal.y() + rho_offset_;
  return angle * rho_count_ + static_cast<int>(rho + 0.5);
}

// The cell with most votes afterwards.
int LineSupport::vote(const Pixel& pixel) {
  int best = -1, most = -1;
  for (int k = -spread_; k <= spread_; ++k) {
    const int cell = cellOf(pixel, (pixel.angle + k + kAngles) % kAngles);
    const int votes = ++votes_[cell];
    if (votes > most) most = votes, best = cell;
  }
  return best;
}

void LineSupport::unvote(const Pixel& pixel) {
  for (int k = -spread_; k <= spread_; ++k) --votes_[cellOf(pixel, (pixel.angle + k + kAngles) % kAngles)];
}

// Number of the unused edge pixel under `at` if its gradient fits the line; -1 if there is none.
inline int LineSupport::pixelAt(const Line& line, const Vector2d& at) const {
  const int x = static_cast<int>(at.x() + 0.5), y = static_cast<int>(at.y() + 0.5);
  if (at.x() < 0.0 || at.y() < 0.0 || x >= index_.cols || y >= index_.rows) return -1;
  const int i = index_.ptr<int>(y)[x] - 1;
  return i >= 0 && bins_.direction(pixels_[i].angle).dot(line.normal) > min_cosine_ ? i : -1;
}

// The same within one pixel of the line.
inline int LineSupport::pixelNear(const Line& line, const Vector2d& at) const {
  int i = pixelAt(line, at);
  if (i < 0) i = pixelAt(line, at + line.normal);
  if (i < 0) i = pixelAt(line, at - line.normal);
  return i;
}

// The sectors in which gradients may fit the line.
std::uint32_t LineSupport::sectorsOf(const Line& line) const {
  constexpr double kFine = 16384.0;
  const int centre =
      bins_.of(static_cast<int>(kFine * line.normal.x()), static_cast<int>(kFine * line.normal.y()));
  const int reach = std::min(kSectors / 2, static_cast<int>(params_.direction_rad * kSectors / kTwoPi) + 1);
  std::uint32_t sectors = 0;
  for (int k = -reach; k <= reach; ++k)
    sectors |= 1U << ((centre * kSectors / kAngles + k + kSectors) % kSectors);
  return sectors;
}

// False only if there is no fitting pixel within one pixel of `at`.
inline bool LineSupport::mayHold(std::uint32_t sectors, const Vector2d& at) const {
  const int x = static_cast<int>(at.x() + 1.5), y = static_cast<int>(at.y() + 1.5);
  if (at.x() < -1.5 || at.y() < -1.5 || x >= surroundings_.cols || y >= surroundings_.rows) return false;
  return (surroundings_.ptr<std::uint32_t>(y)[x] & sectors) != 0;
}

void LineSupport::walkOneWay(const Line& line, std::uint32_t sectors, const Vector2d& start, double way) {
  Vector2d step = way * perpendicular(line.normal);
  step /= step.cwiseAbs().maxCoeff();
  Vector2d at = start - line.normal * line.normal.dot(start - line.point);
  for (double gap = 0.0; gap <= max_gap_px_ + 1.0; at += step, gap += 1.0) {
    if (!mayHold(sectors, at)) continue;
    const int i = pixelNear(line, at);
    if (i < 0) continue;
    gap = 0.0;
    if (found_.empty() || found_.back() != i) found_.push_back(i);
  }
}

void LineSupport::walk(const Line& line, const Vector2d& start) {
  const std::uint32_t sectors = sectorsOf(line);
  found_.clear();
  walkOneWay(line, sectors, start, 1.0);
  walkOneWay(line, sectors, start, -1.0);
}

// Total least squares through the pixels found.
void LineSupport::fit(Line& line) const {
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
}

bool LineSupport::grow(const Pixel& seed, int cell, Segment& segment) {
  const Vector2d start(seed.x, seed.y);
  Line line{start, bins_.direction(cell / rho_count_)};
  found_.clear();
  for (int pass = 0; pass < 3; ++pass) {
    found_before_.swap(found_);
    walk(line, start);
    if (found_.size() < 4) return false;
    if (found_ == found_before_) break;  // neither line nor pixels would change any more
    if (pass < 2) fit(line);
  }
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

// The pixels found are used up.
void LineSupport::take() {
  for (int i : found_) {
    Pixel& pixel = pixels_[i];
    if (pixel.state == 1) unvote(pixel);
    pixel.state = 2;
    index_.at<int>(pixel.y, pixel.x) = 0;
  }
}

std::vector<Segment> LineSupport::run(const EdgeMap& map) {
  prepare(map);
  std::vector<Segment> segments;
  const int threshold = std::max(4, static_cast<int>(params_.vote_fraction * min_length_px_));
  for (int i : order_) {
    Pixel& pixel = pixels_[i];
    if (pixel.state != 0) continue;
    pixel.state = 1;
    const int cell = vote(pixel);
    if (votes_[cell] < threshold) continue;
    Segment segment;
    if (!grow(pixel, cell, segment)) continue;
    take();
    segments.push_back(segment);
  }
  joinCollinear(segments, params_.join_gap);
  keepLongest(segments, params_.max_segments);
  return segments;
}

}  // namespace window_ingress::detection
