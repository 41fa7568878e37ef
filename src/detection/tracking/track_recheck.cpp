#include "detection/tracking/track_recheck.hpp"

#include <algorithm>

#include "detection/quads.hpp"
#include "detection/tracking/image_sequence.hpp"

namespace window_ingress::detection {
namespace {

using geometry::Quadrilateral;

constexpr double kAgreePx = 2.5, kAgreePart = 0.02;  // corners of one window, the larger; in its sizes
constexpr double kSameRival = 0.08;                  // corners of one rival in two images, in sizes
constexpr double kSameSpot = 0.12;                   // corners of other borders of the same window, in sizes
constexpr int kMaxQuestions = 4;                     // times the confirmations; then it rests
constexpr int kPauseFrames = 60;

Quadrilateral relativeTo(const Quadrilateral& frame, const Quadrilateral& quad) {
  Quadrilateral relative;
  for (int i = 0; i < 4; ++i)
    relative[i] = (quad[i] - geometry::centroid(frame)) / std::max(1.0, sizeOf(frame));
  return relative;
}

}  // namespace

void TrackRecheck::start() {
  restart();
  confirmed_ = false;
}

void TrackRecheck::restart() {
  frames_ = asked_ = for_ = against_ = 0;
  doubtful_ = false;
}

bool TrackRecheck::isDue() {
  if (confirmed_ && !doubtful_) return false;
  if (asked_ >= kMaxQuestions * params_.confirmations) {
    const bool pauses = ++frames_ < kPauseFrames;
    if (pauses || !doubtful_) return false;
    asked_ = 0;
  }
  if (++frames_ < kEveryFrames) return false;
  frames_ = 0;
  ++asked_;
  return true;
}

bool TrackRecheck::prefers(const std::optional<Quadrilateral>& searched, const Quadrilateral& followed) {
  if (!searched || !geometry::isFinite(*searched)) return false;
  const double size = sizeOf(followed), off = furthestCorner(*searched, followed);
  if (!(off > std::max(kAgreePx, kAgreePart * size))) {
    against_ = 0;
    if (++for_ >= params_.confirmations) confirmed_ = true, doubtful_ = false, for_ = asked_ = 0;
    return false;
  }
  if (confirmed_ && off > kSameSpot * size) return false;
  const Quadrilateral rival = relativeTo(followed, *searched);
  against_ = against_ > 0 && furthestCorner(rival, rival_) < kSameRival ? against_ + 1 : 1;
  rival_ = rival;
  if (against_ < params_.confirmations) return false;
  restart();
  return true;
}

}  // namespace window_ingress::detection
