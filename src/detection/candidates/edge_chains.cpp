#include "detection/candidates/edge_chains.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr double kMaxTurn_rad = 0.7;  ///< of the gradient between successive pixels [rad]
const float kMinSquareCosine = static_cast<float>(std::pow(std::cos(kMaxTurn_rad), 2));
constexpr double kStraightPx = 0.9;    ///< largest deviation of a run from its chord, at kChainSide [px]
constexpr double kChainSide = 320.0;   ///< longer side of a level [px]
constexpr double kBow = 0.02;          ///< additional deviation, as a part of the chord, for lens distortion
constexpr std::size_t kMinPixels = 4;  ///< shorter runs are dropped
constexpr short kSteps[8][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

// The one of eight steps that is nearest to a direction.
int stepTowards(int x, int y) {
  const int ax = std::abs(x), ay = std::abs(y);
  if (32 * ay < 13 * ax) return x > 0 ? 0 : 4;
  if (32 * ax < 13 * ay) return y > 0 ? 2 : 6;
  return x > 0 ? (y > 0 ? 1 : 7) : (y > 0 ? 3 : 5);
}

}  // namespace

Vector2d LineMoments::along() const {
  const Eigen::Matrix2d spread = squares - sum * sum.transpose() / n;
  const double angle = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
  return {std::cos(angle), std::sin(angle)};
}

// Moves on to the free neighbour that continues the edge, the straightest first; `sense` 1 or -1.
bool EdgeChains::next(const EdgeMap& map, int sense, Pixel& at) {
  const int ahead = stepTowards(-sense * at.dy, sense * at.dx);
  for (int turn : {0, 1, 7}) {
    const short* step = kSteps[(ahead + turn) & 7];
    const int x = at.x + step[0], y = at.y + step[1];
    uchar& free = free_.ptr(y)[x];
    if (!free) continue;
    const Pixel to = pixelAt(map, x, y);
    const float dot = static_cast<float>(to.dx * at.dx + to.dy * at.dy);
    const float squares =
        static_cast<float>(to.dx * to.dx + to.dy * to.dy) * static_cast<float>(at.dx * at.dx + at.dy * at.dy);
    if (dot <= 0.0F || dot * dot < kMinSquareCosine * squares) continue;
    free = 0;
    at = to;
    return true;
  }
  return false;
}

// Adds a part of the chain as a run.
void EdgeChains::emit(std::size_t first, std::size_t last) {
  const std::size_t count = last - first + 1;
  if (count < kMinPixels) return;
  EdgeChain run;
  run.first = static_cast<int>(pixels_.size());
  run.count = static_cast<int>(count);
  Vector2d gradient = Vector2d::Zero();
  for (std::size_t i = first; i <= last; ++i) {
    const Vector2d own(chain_[i].dx, chain_[i].dy);
    run.moments.add(points_[i]);
    gradient += own;
    run.contrast += own.norm();
    pixels_.emplace_back(chain_[i].x, chain_[i].y);
  }
  run.contrast /= run.moments.n * EdgeMap::kSobelGain;
  Vector2d along = run.moments.along();
  if (geometry::cross(along, gradient) < 0.0) along = -along;
  run.normal = {-along.y(), along.x()};  // on the screen, y down, the right of `along`
  const Vector2d mean = run.moments.mean();
  const double begin = along.dot(points_[first] - mean), end = along.dot(points_[last] - mean);
  run.a = mean + std::min({0.0, begin, end}) * along;
  run.b = mean + std::max({0.0, begin, end}) * along;
  runs_.push_back(run);
}

void EdgeChains::tabulate(const geometry::PinholeCamera& lens) {
  if (tabulated_ && *tabulated_ == lens) return;
  tabulated_ = lens;
  undistorted_.create(lens.height, lens.width, CV_32FC2);
  for (int y = 0; y < lens.height; ++y)
    for (int x = 0; x < lens.width; ++x) {
      const Eigen::Vector2f ideal = lens.undistort(Vector2d(x, y)).cast<float>();
      undistorted_.ptr<cv::Vec2f>(y)[x] = {ideal.x(), ideal.y()};
    }
}

// Cuts the chain at its point furthest from the chord until all parts are straight (Douglas and Peucker).
void EdgeChains::cut(bool is_distorted) {
  points_.clear();
  for (const Pixel& p : chain_) {
    const cv::Vec2f ideal = is_distorted ? undistorted_.ptr<cv::Vec2f>(p.y)[p.x] : cv::Vec2f(p.x, p.y);
    points_.emplace_back(ideal[0], ideal[1]);
  }
  parts_.assign(1, {0, points_.size() - 1});
  while (!parts_.empty()) {
    const auto [first, last] = parts_.back();
    parts_.pop_back();
    const Vector2d chord = points_[last] - points_[first];
    const double length = chord.norm();
    double furthest = 0.0;
    std::size_t at = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double off = std::abs(geometry::cross(chord, points_[i] - points_[first]));
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

const std::vector<EdgeChain>& EdgeChains::run(const EdgeMap& map, const geometry::PinholeCamera* lens) {
  if (lens) tabulate(*lens);
  runs_.clear();
  pixels_.clear();
  map.edges.copyTo(free_);
  straight_px_ = kStraightPx * std::max(1.0, std::max(free_.cols, free_.rows) / kChainSide);
  for (int y = 1; y + 1 < free_.rows; ++y) {
    uchar* row = free_.ptr(y);
    for (int x = 1; x + 1 < free_.cols; ++x) {
      if (!row[x]) continue;
      row[x] = 0;
      const Pixel start = pixelAt(map, x, y);
      chain_.clear();
      for (Pixel at = start; next(map, -1, at);) chain_.push_back(at);
      std::reverse(chain_.begin(), chain_.end());
      chain_.push_back(start);
      for (Pixel at = start; next(map, 1, at);) chain_.push_back(at);
      if (chain_.size() >= kMinPixels) cut(lens != nullptr);
    }
  }
  return runs_;
}

}  // namespace window_ingress::detection
