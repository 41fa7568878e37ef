#include "detection/candidates/hough_segments.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr double kOffLine = 0.004;  ///< largest distance of run ends from their line [longer level sides]
constexpr double kLineBow = 0.02;   ///< more distance for lens distortion, as a part of the line's pixels
constexpr double kJoinGap = 0.35;  ///< longest gap over which two pieces of a line are joined [their lengths]
constexpr std::size_t kMaxSegments = 300;  ///< number of strongest segments kept
constexpr double kTwoPi = 6.283185307179586;
constexpr double kDirectionPx = 1.5;     ///< uncertainty of a run's direction times its length [px]
constexpr double kMinSeed = 0.6;         ///< part of the shortest segment that one run must cover
constexpr std::size_t kMaxJoined = 180;  ///< number of segments tried pairwise for joining
constexpr double kSpread = 0.05;         ///< uncertainty of a short seed's direction [rad]
constexpr double kMaxGap = 0.02;         ///< longest gap within a segment [longer level sides]
constexpr double kVotes = 0.7;           ///< votes that start a segment [pixels of the least length]
constexpr double kSameDirection = 0.99;  ///< cosine between pieces of one line

Vector2d right(const Vector2d& along) { return {-along.y(), along.x()}; }

// Joins collinear pairs into additional segments; the pieces stay.
void joinCollinear(std::vector<Segment>& segments, double off_line_px) {
  const std::size_t count = std::min(segments.size(), kMaxJoined);
  for (std::size_t i = 0; i < count; ++i) {
    const Segment p = segments[i];
    const double p_length = p.length();
    const Vector2d along = (p.b - p.a) / p_length;
    for (std::size_t j = 0; j < count; ++j) {
      const Segment& q = segments[j];
      if (p.normal.dot(q.normal) < kSameDirection) continue;
      const double gap = along.dot(q.a - p.b);
      if (gap < 0.0 || gap > kJoinGap * (p_length + q.length())) continue;
      const Vector2d joint = (q.b - p.a).normalized(), normal = right(joint);
      const double off_px = off_line_px + kLineBow * (p.pixels + q.pixels);
      if (std::abs(normal.dot(p.b - p.a)) > off_px || std::abs(normal.dot(q.a - p.a)) > off_px) continue;
      const double pixels = p.pixels + q.pixels;
      const double contrast = (p.contrast * p.pixels + q.contrast * q.pixels) / pixels;
      segments.push_back({p.a, q.b, normal, pixels, contrast});
    }
  }
}

// Keeps the strongest, by length and the root of the contrast.
void keepStrongest(std::vector<Segment>& segments) {
  std::stable_sort(segments.begin(), segments.end(), [](const Segment& p, const Segment& q) {
    return (p.b - p.a).squaredNorm() * p.contrast > (q.b - q.a).squaredNorm() * q.contrast;
  });
  if (segments.size() > kMaxSegments) segments.resize(kMaxSegments);
}

}  // namespace

void HoughSegments::prepare(const cv::Size& level) {
  const double side = std::max(level.width, level.height);
  min_length_px_ = std::max(5.0, params_.min_length * side);
  max_gap_px_ = kMaxGap * side;
  off_line_px_ = std::max(0.9, kOffLine * side);
  centre_ = 0.5 * Vector2d(level.width, level.height);
  rhos_ = static_cast<int>(2.6 * centre_.norm() / kRhoStepPx) + 2;
  if (normals_.empty())
    for (int k = 0; k < kAngles; ++k)
      normals_.emplace_back(std::cos(k * kTwoPi / kAngles), std::sin(k * kTwoPi / kAngles));
}

// Cell of the line at this angle through a point.
int HoughSegments::cellOf(const Vector2d& point, int angle) const {
  const int a = (angle + kAngles) % kAngles;
  const double rho = normals_[a].dot(point - centre_) / kRhoStepPx + 0.5 * rhos_;
  return a * rhos_ + std::clamp(static_cast<int>(rho), 0, rhos_ - 1);
}

// Each run votes for all angles within the uncertainty of its direction. Voters are listed by counting sort.
void HoughSegments::vote(const std::vector<EdgeChain>& runs) {
  const std::size_t cells = static_cast<std::size_t>(kAngles) * rhos_;
  votes_.assign(cells, 0.0F);
  starts_.assign(cells + 2, 0);
  cells_.clear();
  ballots_.clear();
  for (const EdgeChain& run : runs) {
    const double angle = std::atan2(run.normal.y(), run.normal.x()) * kAngles / kTwoPi;
    const double open = kDirectionPx / run.moments.n * kAngles / kTwoPi;
    ballots_.push_back({run.moments.mean(), static_cast<int>(std::lround(angle - open)),
                        static_cast<int>(std::lround(angle + open))});
    for (int k = ballots_.back().first_angle; k <= ballots_.back().last_angle; ++k) {
      const int cell = cellOf(ballots_.back().middle, k);
      cells_.push_back(cell);
      votes_[cell] += static_cast<float>(run.moments.n);
      ++starts_[cell + 2];
    }
  }
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  voters_.resize(cells_.size());
  const int* cell = cells_.data();
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (int k = ballots_[i].first_angle; k <= ballots_[i].last_angle; ++k)
      voters_[starts_[*cell++ + 1]++] = static_cast<int>(i);
}

// Runs that voted for the seed's line or an adjacent one, ordered along it.
void HoughSegments::collect(const std::vector<EdgeChain>& runs, int seed) {
  members_.clear();
  const auto [middle, first_angle, last_angle] = ballots_[seed];
  const Vector2d along = (runs[seed].b - runs[seed].a).normalized(), across = right(along);
  for (int angle = first_angle; angle <= last_angle; ++angle) {
    const int cell = cellOf(middle, angle), row = cell / rhos_ * rhos_;
    for (int c = std::max(row, cell - 1); c <= std::min(row + rhos_ - 1, cell + 1); ++c)
      for (int v = starts_[c]; v < starts_[c + 1]; ++v) {
        const int i = voters_[v];
        if (used_[i] || asked_[i] == seed) continue;
        asked_[i] = seed;
        const Vector2d apart = ballots_[i].middle - middle;
        const double ahead = along.dot(apart), off = std::abs(across.dot(apart));
        if (i == seed || off > 2.0 * off_line_px_ + (kSpread + kLineBow) * std::abs(ahead)) continue;
        const double half = 0.5 * runs[i].moments.n;
        members_.push_back({ahead - half, ahead + half, i});
      }
  }
  std::sort(members_.begin(), members_.end(), [](const Member& p, const Member& q) {
    return p.from < q.from || (p.from == q.from && p.run < q.run);
  });
}

// Takes the runs on the line up to the first gap; `way` 1 towards b, -1 towards a.
void HoughSegments::extend(const std::vector<EdgeChain>& runs, int way, LineMoments& moments, double& end) {
  Vector2d mean = moments.mean(), normal = right(moments.along());
  const int count = static_cast<int>(members_.size());
  for (int k = 0; k < count; ++k) {
    const Member& m = members_[way > 0 ? k : count - 1 - k];
    const double near = way > 0 ? m.from : m.to, far = way > 0 ? m.to : m.from;
    if (way * (far - end) <= 0.0) continue;
    if (way * (near - end) > max_gap_px_) break;
    const EdgeChain& other = runs[m.run];
    const double off_px = off_line_px_ + kLineBow * moments.n;
    if (std::abs(normal.dot(other.a - mean)) > off_px || std::abs(normal.dot(other.b - mean)) > off_px)
      continue;
    moments.add(other.moments);
    mean = moments.mean(), normal = right(moments.along());
    end = far;
    taken_.push_back(m.run);
  }
}

bool HoughSegments::grow(const std::vector<EdgeChain>& runs, int seed, Segment& segment) {
  const EdgeChain& own = runs[seed];
  collect(runs, seed);
  taken_.assign(1, seed);
  LineMoments moments = own.moments;
  const Vector2d start = moments.mean(), before = (own.b - own.a).normalized();
  double high = before.dot(own.b - start), low = before.dot(own.a - start);
  extend(runs, 1, moments, high);
  extend(runs, -1, moments, low);
  const Vector2d mean = moments.mean();
  Vector2d along = moments.along();
  if (along.dot(before) < 0.0) along = -along;
  low = high = 0.0;
  segment.contrast = 0.0;
  for (int i : taken_) {
    low = std::min(low, along.dot(runs[i].a - mean)), high = std::max(high, along.dot(runs[i].b - mean));
    segment.contrast += runs[i].contrast * runs[i].moments.n / moments.n;
  }
  segment.a = mean + low * along, segment.b = mean + high * along;
  segment.normal = right(along);
  segment.pixels = moments.n;
  const double steps = (high - low) * along.cwiseAbs().maxCoeff();
  return high - low >= min_length_px_ && moments.n >= params_.min_density * steps;
}

const std::vector<Segment>& HoughSegments::run(const std::vector<EdgeChain>& runs, const cv::Size& level) {
  prepare(level);
  vote(runs);
  segments_.clear();
  used_.assign(runs.size(), 0);
  asked_.assign(runs.size(), -1);
  std::vector<int> order(runs.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&runs](int i, int k) { return runs[i].moments.n > runs[k].moments.n; });
  for (int seed : order) {
    if (runs[seed].moments.n < kMinSeed * min_length_px_) break;
    const auto& [middle, first_angle, last_angle] = ballots_[seed];
    const float votes = votes_[cellOf(middle, (first_angle + last_angle) / 2)];
    if (used_[seed] || votes < kVotes * min_length_px_) continue;
    Segment segment;
    if (!grow(runs, seed, segment)) continue;
    for (int i : taken_) used_[i] = 1;
    segments_.push_back(segment);
  }
  keepStrongest(segments_);
  joinCollinear(segments_, off_line_px_);
  keepStrongest(segments_);
  return segments_;
}

cv::Mat edgesOnSegments(const EdgeChains& runs, const HoughSegments& lines, const cv::Size& level,
                        cv::Mat edges) {
  edges.create(level, CV_8UC1);
  edges.setTo(0);
  for (std::size_t i = 0; i < runs.runs().size(); ++i) {
    if (!lines.onSegment()[i]) continue;
    const auto first = runs.pixels().begin() + runs.runs()[i].first;
    std::for_each(first, first + runs.runs()[i].count,
                  [&edges](const auto& p) { edges.ptr(p.y)[p.x] = 255; });
  }
  return edges;
}

}  // namespace window_ingress::detection
