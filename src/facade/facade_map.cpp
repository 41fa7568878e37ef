#include "window_ingress/facade/facade_map.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace window_ingress::facade {
namespace {

constexpr std::size_t kMaxWindows = 64;
constexpr double kSameSpot = 0.4;  // of the smaller width: two windows cannot be this close

constexpr double kMaxSquares = 3.5 * 3.5;  // squared Mahalanobis distance of a place from its window
constexpr double kForgetSec = 2.0;         // without a sight, for a window without a number
constexpr double kForgetGuessSec = 3.0;    // without a sight, for a window of guessed distance
constexpr double kMinSize = 0.5;           // of the expected size; smaller: stones, panes, strips of a frame
constexpr double kSightsOverFilter = 2.0;  // odometry's drift between two sights, over the filter's parameter
constexpr double kSizeRatio = 1.35;        // above which two loops are different windows
constexpr double kOnWallRatio = 1.5;       // of sizes measured on the wall: one may be cut off, or a frame's

bool areAlike(const geometry::OpeningSize& a, const geometry::OpeningSize& b, double ratio) {
  const double wider = a.width_m / b.width_m, higher = a.height_m / b.height_m;
  return std::max({wider, 1.0 / wider, higher, 1.0 / higher}) < ratio;
}

// Compares sizes if both were measured: a pane, or something seen through the window, is not the window.
bool sizesAgree(const WindowPlace& a, const WindowPlace& b) {
  return !a.on_wall || !b.on_wall || areAlike(a.size, b.size, kOnWallRatio);
}

// Compares distances if neither was measured. Both then follow from the expected size, so another distance
// means another size. A large loop near the camera is not the window behind it.
bool distancesAgree(const WindowPlace& a, const WindowPlace& b, const Eigen::Vector3d& eye_m) {
  if (a.on_wall || b.on_wall) return true;
  const double further = (a.position_m - eye_m).norm() / (b.position_m - eye_m).norm();
  return std::max(further, 1.0 / further) < kSizeRatio;
}

bool inOneSpot(const WindowPlace& a, const WindowPlace& b) {
  const double width_m = std::min(a.size.width_m, b.size.width_m);
  return (a.position_m - b.position_m).norm() <= kSameSpot * width_m;
}

template <typename Windows>
auto withNumber(Windows& windows, std::uint32_t KnownWindow::*number, std::uint32_t value) {
  const auto it = std::find_if(windows.begin(), windows.end(),
                               [&](const auto& window) { return window.*number == value; });
  return it == windows.end() ? nullptr : &*it;
}

// Combines two entries of one window. The number `kept` stays, else that of the older one.
void absorb(KnownWindow& window, const KnownWindow& twin, std::uint32_t kept) {
  if (window.id == 0 || (twin.id != 0 && twin.id == kept)) window.id = twin.id;
  window.place = fused(window.place, twin.place);
  window.last_seen_sec = std::max(window.last_seen_sec, twin.last_seen_sec);
  window.sights += twin.sights;
  window.visits += twin.visits;
  window.failures += twin.failures;
  window.may_be_target = window.may_be_target || twin.may_be_target;
  if (twin.bhattacharyya)
    window.bhattacharyya = std::min(*twin.bhattacharyya, window.bhattacharyya.value_or(1.0));
  if (window.openness.openness == openness::Openness::kUnknown) window.openness = twin.openness;
}

}  // namespace

// Two windows cannot share one spot. There, a large distance means that odometry slid by more than its stated
// drift.
double FacadeMap::squares(const KnownWindow& window, const WindowPlace& place, double stamp_sec) const {
  const double since_sec = std::abs(stamp_sec - window.last_seen_sec);
  const double squares = squaresBetween(
      window.place, place, std::pow(kSightsOverFilter * params_.odom_drift_m_per_sqrt_sec, 2) * since_sec);
  return inOneSpot(window.place, place) ? std::min(squares, kMaxSquares) : squares;
}

void FacadeMap::associate(const FacadeView& view, std::vector<Sight>& sights) const {
  const Eigen::Vector3d eye_m = view.from.T_odom_camera.translation();
  std::vector<std::tuple<double, std::uint32_t, Sight*>> pairs;
  for (const KnownWindow& window : windows_)
    for (Sight& sight : sights)
      if (const double squares = this->squares(window, sight.place, view.stamp_sec);
          squares <= kMaxSquares && sizesAgree(window.place, sight.place) &&
          distancesAgree(window.place, sight.place, eye_m))
        pairs.emplace_back(squares, window.key, &sight);
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [squares, key, sight] : pairs) {
    const auto is_taken = [key = key](const Sight& other) { return other.key == key; };
    if (sight->key == 0 && std::none_of(sights.begin(), sights.end(), is_taken)) sight->key = key;
  }
}

// In a full map new windows take the place of those not seen for longest, never of one that was flown at.
void FacadeMap::makeRoom(const std::vector<Sight>& sights, std::uint32_t kept) {
  const auto is_new = [](const Sight& sight) { return sight.key == 0; };
  const auto wanted = static_cast<std::size_t>(std::count_if(sights.begin(), sights.end(), is_new));
  const auto is_needed = [&](const KnownWindow& window) {
    const auto shows = [&](const Sight& sight) { return sight.key == window.key; };
    return (kept != 0 && window.id == kept) || window.visits > 0 || window.failures > 0 ||
           std::any_of(sights.begin(), sights.end(), shows);
  };
  while (windows_.size() + wanted > kMaxWindows) {
    auto oldest = windows_.end();
    for (auto window = windows_.begin(); window != windows_.end(); ++window)
      if (!is_needed(*window) && (oldest == windows_.end() || window->last_seen_sec < oldest->last_seen_sec))
        oldest = window;
    if (oldest == windows_.end()) return;
    windows_.erase(oldest);
  }
}

void FacadeMap::learn(double stamp_sec, Sight& sight) {
  KnownWindow* window = withNumber(windows_, &KnownWindow::key, sight.key);
  if (window == nullptr) {
    if (windows_.size() >= kMaxWindows) return;
    windows_.emplace_back();
    window = &windows_.back();
    window->key = sight.key = ++last_key_;
    window->place = sight.place;
  } else {
    window->place = fused(window->place, sight.place);
  }
  window->last_seen_sec = stamp_sec;
  window->score = sight.seen->score;
  window->may_be_target = sight.seen->may_be_target;
  // Without a known wall any rectangle may be anywhere, so its appearance must qualify it.
  const bool is_window = window->may_be_target || window->place.on_wall;
  if (++window->sights >= kMinSights && is_window && window->id == 0) window->id = ++last_id_;
  if (sight.seen->has_appearance)
    window->bhattacharyya = std::min(sight.seen->bhattacharyya, window->bhattacharyya.value_or(1.0));
  if (sight.seen->is_target) followed_key_ = sight.key;
}

bool FacadeMap::isOfSize(const KnownWindow& window, const geometry::OpeningSize& looked_for) {
  return window.place.on_wall && areAlike(window.place.size, looked_for, kSizeRatio);
}

void FacadeMap::noteSideBySide(const std::vector<Sight>& sights) {
  for (const Sight& a : sights)
    for (const Sight& b : sights)
      if (a.key != 0 && a.key < b.key) apart_.emplace(a.key, b.key);
}

// Windows seen beside the younger one are not the older one either.
void FacadeMap::passOnNeighbours(std::uint32_t younger, std::uint32_t older) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> apart;
  for (const auto& [a, b] : apart_)
    apart.insert(std::minmax(a == younger ? older : a, b == younger ? older : b));
  apart_ = std::move(apart);
}

// Merges windows in one spot; the older one stays.
void FacadeMap::merge(std::uint32_t kept) {
  for (std::size_t i = 0; i < windows_.size(); ++i)
    for (std::size_t k = windows_.size(); --k > i;) {
      KnownWindow &older = windows_[i], &younger = windows_[k];
      if (apart_.count({older.key, younger.key}) != 0 || !inOneSpot(older.place, younger.place) ||
          !sizesAgree(older.place, younger.place))
        continue;
      if (followed_key_ == younger.key) followed_key_ = older.key;
      absorb(older, younger, kept);
      passOnNeighbours(younger.key, older.key);
      windows_.erase(windows_.begin() + static_cast<std::ptrdiff_t>(k));
    }
}

// Also drops windows whose distance was guessed from the expected size and that are not seen there. Only
// images that were searched count: these show other windows than the tracked one.
void FacadeMap::prune(const FacadeView& view, bool knows_wall, std::uint32_t kept) {
  const bool was_searched = std::any_of(view.windows.begin(), view.windows.end(),
                                        [](const detection::SeenWindow& seen) { return !seen.is_target; });
  const auto is_stale = [&](const KnownWindow& window) {
    const double unseen_sec = view.stamp_sec - window.last_seen_sec;
    if (!window.isConfirmed()) return unseen_sec > kForgetSec;
    return knows_wall && !window.place.on_wall && window.id != kept && was_searched &&
           unseen_sec > kForgetGuessSec && inView(window.place, view.from);
  };
  windows_.erase(std::remove_if(windows_.begin(), windows_.end(), is_stale), windows_.end());
}

void FacadeMap::forgetNeighbours() {
  const auto is_known = [&](std::uint32_t key) {
    return withNumber(windows_, &KnownWindow::key, key) != nullptr;
  };
  for (auto pair = apart_.begin(); pair != apart_.end();)
    pair = is_known(pair->first) && is_known(pair->second) ? std::next(pair) : apart_.erase(pair);
}

void FacadeMap::addView(const FacadeView& view, const std::optional<Wall>& wall,
                        const geometry::OpeningSize& looked_for, std::uint32_t kept) {
  const auto is_too_small = [&](const WindowPlace& place) {
    return place.on_wall && (place.size.width_m < kMinSize * looked_for.width_m ||
                             place.size.height_m < kMinSize * looked_for.height_m);
  };
  std::vector<Sight> sights;
  for (const detection::SeenWindow& seen : view.windows)
    if (const auto place = placeOf(seen.corners, view.from, wall, looked_for); place && !is_too_small(*place))
      sights.push_back({&seen, *place});
  followed_key_ = 0;
  associate(view, sights);
  makeRoom(sights, kept);
  for (Sight& sight : sights) learn(view.stamp_sec, sight);
  noteSideBySide(sights);
  merge(kept);
  prune(view, wall.has_value(), kept);
  forgetNeighbours();
}

const KnownWindow* FacadeMap::at(const WindowPlace& place, double stamp_sec) const {
  const KnownWindow* nearest = nullptr;
  double least = kMaxSquares;
  for (const KnownWindow& window : windows_)
    if (const double squares = this->squares(window, place, stamp_sec);
        squares <= least && sizesAgree(window.place, place))
      least = squares, nearest = &window;
  return nearest;
}

const KnownWindow* FacadeMap::find(std::uint32_t id) const {
  return id == 0 ? nullptr : withNumber(windows_, &KnownWindow::id, id);
}

KnownWindow* FacadeMap::find(std::uint32_t id) {
  return id == 0 ? nullptr : withNumber(windows_, &KnownWindow::id, id);
}

KnownWindow* FacadeMap::followed() {
  KnownWindow* window = withNumber(windows_, &KnownWindow::key, followed_key_);
  return window != nullptr && window->isConfirmed() ? window : nullptr;
}

}  // namespace window_ingress::facade
