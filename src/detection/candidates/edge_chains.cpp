#include "detection/candidates/edge_chains.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr double kMaxTurn_rad =
    0.7;  ///< largest difference in gradient direction between successive pixels [rad]
const float kMinSquareCosine = static_cast<float>(std::pow(std::cos(kMaxTurn_rad), 2));
constexpr double kStraightPx =
    0.9;                       ///< largest deviation of a run from its chord, at a level side of 320 [px]
constexpr double kBow = 0.02;  ///< additional deviation, as a part of the chord, for lens distortion
constexpr int kMinPixels = 4;  ///< shorter runs are dropped
constexpr double kChainSide = 320.0;
constexpr short kSteps[8][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

// The one of eight steps that is nearest to a direction.
int stepTowards(int x, int y) {
  const int ax = std::abs(x), ay = std::abs(y);
  if (32 * ay < 13 * ax) return x > 0 ? 0 : 4;
  if (32 * ax < 13 * ay) return y > 0 ? 2 : 6;
  return x > 0 ? (y > 0 ? 1 : 7) : (y > 0 ? 3 : 5);
}

}  // namespace

void LineMoments::add(const Vector2d& p) {
  n += 1.0, x += p.x(), y += p.y();
  xx += p.x() * p.x(), xy += p.x() * p.y(), yy += p.y() * p.y();
}

void LineMoments::add(const LineMoments& other) {
  n += other.n, x += other.x, y += other.y, xx += other.xx, xy += other.xy, yy += other.yy;
}

Vector2d LineMoments::along() const {
  const double a = xx - x * x / n, b = xy - x * y / n, c = yy - y * y / n;
  const double angle = 0.5 * std::atan2(2.0 * b, a - c);
  return {std::cos(angle), std::sin(angle)};
}

// The free neighbour that continues the edge, the straightest first.
bool EdgeChains::next(const EdgeMap& map, int sense, Pixel& at) {
  const int ahead = stepTowards(-sense * at.dy, sense * at.dx);
  for (int turn : {0, 1, 7}) {
    const short* step = kSteps[(ahead + turn) & 7];
    const int x = at.x + step[0], y = at.y + step[1];
    uchar& free = free_.ptr(y)[x];
    if (!free) continue;
    const short dx = map.dx.ptr<short>(y)[x], dy = map.dy.ptr<short>(y)[x];
    const float dot = static_cast<float>(dx * at.dx + dy * at.dy);
    const float squares =
        static_cast<float>(dx * dx + dy * dy) * static_cast<float>(at.dx * at.dx + at.dy * at.dy);
    if (dot <= 0.0F || dot * dot < kMinSquareCosine * squares) continue;
    free = 0;
    at = {static_cast<short>(x), static_cast<short>(y), dx, dy};
    return true;
  }
  return false;
}

void EdgeChains::follow(const EdgeMap& map, Pixel at, int sense, std::vector<Pixel>& pixels) {
  pixels.clear();
  while (next(map, sense, at)) pixels.push_back(at);
}

// Adds a part of the chain as a run.
void EdgeChains::emit(std::size_t first, std::size_t last) {
  if (last - first + 1 < static_cast<std::size_t>(kMinPixels)) return;
  EdgeChain run;
  Vector2d gradient = Vector2d::Zero();
  for (std::size_t i = first; i <= last; ++i) {
    run.moments.add(points_[i]);
    const Vector2d own(forward_[i].dx, forward_[i].dy);
    gradient += own;
    run.contrast += own.norm();
  }
  run.first = static_cast<int>(pixels_.size());
  run.count = static_cast<int>(last - first + 1);
  for (std::size_t i = first; i <= last; ++i) pixels_.emplace_back(forward_[i].x, forward_[i].y);
  run.contrast /= run.moments.n * EdgeMap::kSobelGain;
  Vector2d along = run.moments.along();
  // On the screen, y down, the right of `along` is (-y, x).
  if (along.x() * gradient.y() - along.y() * gradient.x() < 0.0) along = -along;
  run.normal = Vector2d(-along.y(), along.x());
  const Vector2d mean = run.moments.mean();
  double low = 0.0, high = 0.0;
  for (std::size_t i : {first, last}) {
    const double t = along.dot(points_[i] - mean);
    low = std::min(low, t), high = std::max(high, t);
  }
  run.a = mean + low * along, run.b = mean + high * along;
  runs_.push_back(run);
}

// Cuts the chain at its point furthest from the chord until all parts are straight (Douglas and Peucker).
void EdgeChains::cut(const UndistortionMap& lens) {
  points_.clear();
  for (const Pixel& p : forward_) points_.push_back(lens.undistort(p.x, p.y));
  parts_.assign(1, {0, points_.size() - 1});
  while (!parts_.empty()) {
    const auto [first, last] = parts_.back();
    parts_.pop_back();
    const Vector2d chord = points_[last] - points_[first];
    const double length = chord.norm();
    double furthest = 0.0;
    std::size_t at = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const Vector2d d = points_[i] - points_[first];
      const double off = std::abs(chord.x() * d.y() - chord.y() * d.x());
      if (off > furthest) furthest = off, at = i;
    }
    if (furthest > (straight_px_ + kBow * length) * length) {
      parts_.emplace_back(at, last);
      parts_.emplace_back(first, at);
    } else {
      emit(first, last);
    }
  }
}

const std::vector<EdgeChain>& EdgeChains::run(const EdgeMap& map, const UndistortionMap& lens) {
  runs_.clear();
  pixels_.clear();
  map.edges.copyTo(free_);
  straight_px_ = kStraightPx * std::max(1.0, std::max(free_.cols, free_.rows) / kChainSide);
  for (int y = 1; y + 1 < free_.rows; ++y) {
    uchar* row = free_.ptr(y);
    for (int x = 1; x + 1 < free_.cols; ++x) {
      if (!row[x]) continue;
      row[x] = 0;
      const Pixel start = {static_cast<short>(x), static_cast<short>(y), map.dx.ptr<short>(y)[x],
                           map.dy.ptr<short>(y)[x]};
      follow(map, start, -1, backward_);
      std::reverse(backward_.begin(), backward_.end());
      backward_.push_back(start);
      follow(map, start, 1, forward_);
      backward_.insert(backward_.end(), forward_.begin(), forward_.end());
      forward_.swap(backward_);
      if (forward_.size() >= static_cast<std::size_t>(kMinPixels)) cut(lens);
    }
  }
  return runs_;
}

}  // namespace window_ingress::detection
