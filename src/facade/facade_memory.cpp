#include "window_ingress/facade/facade_memory.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::facade {
namespace {

constexpr double kLongestGapSec = 0.5;   // between images; longer gaps do not count
constexpr int kSettledUpdates = 15;      // of the estimate, after which the tracked window becomes the target
constexpr double kNextReleaseSec = 1.5;  // as `release_sec`, for a target that was the next best
constexpr double kMaxClickM = 1.0;       // of a click from a window
constexpr double kNearestSigmaM = 0.03;  // least standard deviation of a place in odom

WindowPlace placeFrom(const TrackedWindow& tracked) {
  WindowPlace place;
  place.position_m = tracked.T_odom_window.translation();
  place.covariance = tracked.covariance.topLeftCorner<3, 3>() +
                     kNearestSigmaM * kNearestSigmaM * Eigen::Matrix3d::Identity();
  place.heading_rad = geometry::yawOf(tracked.T_odom_window.linear());
  place.size = tracked.size;
  place.on_wall = true;
  return place;
}

Wall wallFrom(const TrackedWindow& tracked) {
  const Eigen::Vector3d through = tracked.T_odom_window.linear().col(0);
  Wall wall;
  wall.position_m = tracked.T_odom_window.translation();
  wall.heading_rad = geometry::yawOf(tracked.T_odom_window.linear());
  wall.sigma_m = std::sqrt(through.dot(tracked.covariance.topLeftCorner<3, 3>() * through));
  wall.heading_sigma_rad = std::sqrt(tracked.covariance(5, 5));
  return wall;
}

std::string name(std::uint32_t id) { return "window " + std::to_string(id); }

bool isClosed(const KnownWindow& window) { return window.openness.openness == openness::Openness::kClosed; }

}  // namespace

FacadeMemory::FacadeMemory(const FacadeParams& params)
    : params_(parameters::requireInRange(params, "facade")), map_(params) {}

void FacadeMemory::reset() { *this = FacadeMemory(params_); }

void FacadeMemory::forgetPlaces() {
  FacadeMemory empty(params_);
  empty.choice_is_lost_ = target() == nullptr ? choice_is_lost_ : is_chosen_;
  empty.choice_is_given_up_ = choice_is_given_up_;
  empty.target_track_id_ = target_track_id_;
  *this = std::move(empty);
}

void FacadeMemory::setTarget(std::uint32_t id, bool is_chosen) {
  target_id_ = id;
  is_chosen_ = is_chosen;
  choice_is_lost_ = choice_is_given_up_ = is_next_ = false;
  missing_sec_ = 0.0;
}

void FacadeMemory::setNextBest() {
  const KnownWindow* next = nextBest();
  setTarget(next == nullptr ? 0 : next->id, next != nullptr);
  is_next_ = next != nullptr;
}

void FacadeMemory::addView(const FacadeView& view, const std::optional<TrackedWindow>& tracked,
                           const geometry::OpeningSize& looked_for) {
  if (!params_.enabled) return;
  looked_for_ = looked_for;
  if (tracked && tracked->sign_trusted) wall_ = wallFrom(*tracked);
  map_.addView(view, wall_, looked_for, target_id_);
  if (target() == nullptr) target_id_ = 0;
  if (tracked) adopt(*tracked, view.track_id);
  yieldToBetterLook();
  releaseIfGone(view);
}

void FacadeMemory::adopt(const TrackedWindow& tracked, std::uint32_t track_id) {
  KnownWindow* followed = map_.followed();
  if (followed == nullptr) return;
  if (choice_is_lost_ && track_id != 0 && track_id == target_track_id_) setTarget(followed->id, true);
  if (tracked.sign_trusted) followed->place = placeFrom(tracked);
  const bool has_settled = tracked.updates >= kSettledUpdates;
  const bool is_free = target_id_ == 0 && !choice_is_lost_ && !choice_is_given_up_;
  if (is_free && has_settled && followed->failures == 0) setTarget(followed->id, false);
  if (followed->id == target_id_) target_track_id_ = track_id;
}

// The reference decides: a window that matches it clearly better is the target, not a neighbour.
void FacadeMemory::yieldToBetterLook() {
  const KnownWindow* now = target();
  if (now == nullptr || is_chosen_ || !now->bhattacharyya) return;
  const double needed = *now->bhattacharyya - params_.distance_margin;
  const auto is_better = [&](const KnownWindow& other) {
    return other.may_be_target && other.failures == 0 && other.isConfirmed() &&
           other.bhattacharyya.value_or(1.0) < needed;
  };
  if (std::any_of(windows().begin(), windows().end(), is_better)) setTarget(0, false);
}

// Releases a target that is gone, unless a person chose it.
void FacadeMemory::releaseIfGone(const FacadeView& view) {
  const double elapsed_sec =
      std::clamp(view.stamp_sec - last_view_sec_.value_or(view.stamp_sec), 0.0, kLongestGapSec);
  last_view_sec_ = view.stamp_sec;
  const KnownWindow* now = target();
  if (now == nullptr || now->last_seen_sec >= view.stamp_sec)
    missing_sec_ = 0.0;
  else if (expected(view.from))
    missing_sec_ += elapsed_sec;
  if (is_chosen_ && !is_next_) return;
  if (missing_sec_ <= (is_next_ ? kNextReleaseSec : params_.release_sec)) return;
  if (!is_next_) return setTarget(0, false);
  ++map_.find(target_id_)->failures;
  setNextBest();
}

std::string FacadeMemory::whyNotTarget(const detection::WindowObservation& window, const Viewpoint& from,
                                       const geometry::OpeningSize& looked_for) const {
  const KnownWindow* target = this->target();
  if (!params_.enabled || !window.whole()) return "";
  if (choice_is_lost_ && window.target_id != target_track_id_)
    return "the chosen window is lost because odometry jumped: choose again (~select_window)";
  if (choice_is_given_up_)
    return "the chosen window was given up: choose another one (~select_window), or allow search/next_window";
  if (target == nullptr) return "";
  const Wall wall{target->place.position_m, target->place.heading_rad, kWallSigmaM, 0.0};
  const auto place =
      placeOf(window.corners, from, target->place.on_wall ? std::optional(wall) : std::nullopt, looked_for);
  if (!place) return "";
  const KnownWindow* seen = map_.at(*place, window.stamp_sec);
  if (seen != nullptr && seen->id == target->id) return "";
  const double apart_m = (place->position_m - target->place.position_m).norm();
  const bool is_listed = seen != nullptr && seen->isConfirmed();
  return formatted("%s, %.1f m from window %u, which is the target",
                   is_listed ? name(seen->id).c_str() : "another window", apart_m, target->id);
}

std::optional<geometry::Quadrilateral> FacadeMemory::expected(const Viewpoint& from) const {
  const KnownWindow* target = this->target();
  if (!params_.enabled || target == nullptr) return std::nullopt;
  return inView(target->place, from);
}

Reply FacadeMemory::select(std::uint32_t id) {
  if (id == 0) {
    setTarget(0, false);
    return {true, "no window is chosen: the tracked window becomes the target"};
  }
  const KnownWindow* window = map_.find(id);
  if (window == nullptr || !window->isConfirmed()) return {false, "no " + name(id) + " is known"};
  if (isClosed(*window)) return {false, name(id) + " was seen to be closed: " + window->openness.reason};
  setTarget(id, true);
  map_.find(id)->failures = 0;
  return {true, name(id) + " is the target" +
                    (window->may_be_target ? "" : ", though it does not look like the reference")};
}

Reply FacadeMemory::selectNear(const Eigen::Vector3d& point_odom_m) {
  // The window clicked into; of several, such as a window and its pane, the one seen most often.
  const auto rank = [&](const KnownWindow& window) {
    const double apart_m = (window.place.position_m - point_odom_m).norm();
    return std::make_tuple(std::max(0.0, apart_m - 0.5 * window.place.size.width_m), -window.sights);
  };
  const KnownWindow* nearest = nullptr;
  for (const KnownWindow& window : windows()) {
    if (!window.isConfirmed() || std::get<0>(rank(window)) > kMaxClickM) continue;
    if (nearest == nullptr || rank(window) < rank(*nearest)) nearest = &window;
  }
  if (nearest != nullptr) return select(nearest->id);
  return {false, formatted("no window is known within %.1f m of (%.1f, %.1f, %.1f)", kMaxClickM,
                           point_odom_m.x(), point_odom_m.y(), point_odom_m.z())};
}

void FacadeMemory::giveUp(const std::vector<std::uint32_t>& ids, bool next_one) {
  for (const std::uint32_t id : ids)
    if (KnownWindow* window = map_.find(id)) ++window->failures;
  if (target_id_ == 0 || std::find(ids.begin(), ids.end(), target_id_) == ids.end()) return;
  if (next_one) return setNextBest();
  const bool was_chosen = is_chosen_;
  setTarget(0, false);
  choice_is_given_up_ = was_chosen;
}

const KnownWindow* FacadeMemory::nextBest() const {
  const KnownWindow* best = nullptr;
  const auto rank = [](const KnownWindow& window) {
    return std::make_tuple(window.openness.openness == openness::Openness::kOpen,
                           -window.bhattacharyya.value_or(1.0), window.score);
  };
  for (const KnownWindow& window : windows()) {
    const bool may_be = window.isConfirmed() && window.may_be_target && window.failures == 0 &&
                        !isClosed(window) && FacadeMap::isOfSize(window, looked_for_);
    if (!may_be) continue;
    if (best == nullptr || rank(window) > rank(*best)) best = &window;
  }
  return best;
}

void FacadeMemory::noteFlownAt(std::uint32_t id) {
  if (KnownWindow* window = id != flown_at_ ? map_.find(id) : nullptr) ++window->visits;
  flown_at_ = id;
}

void FacadeMemory::judge(const openness::OpennessVerdict& verdict) {
  if (KnownWindow* window = map_.find(target_id_)) window->openness = verdict;
}

}  // namespace window_ingress::facade
