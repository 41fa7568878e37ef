#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "window_ingress/detection/seen_windows.hpp"
#include "window_ingress/facade/facade_params.hpp"
#include "window_ingress/facade/window_place.hpp"
#include "window_ingress/openness/openness_verdict.hpp"

namespace window_ingress::facade {

/// A window that was seen, and what is known of it.
struct KnownWindow {
  std::uint32_t id = 0;   ///< from 1, once enough images have shown it, on the wall or like the target; never
                          ///< given to another one, but after a reset
  std::uint32_t key = 0;  ///< from 1, since the first image that showed it; the older one's is less
  WindowPlace place;
  double last_seen_sec = 0.0;
  int sights = 0;                       ///< images that showed it
  double score = 0.0;                   ///< of the last of them, 0 to 1
  std::optional<double> bhattacharyya;  ///< least distance to the reference so far
  bool may_be_target = false;           ///< nothing in the last image spoke against its look
  openness::OpennessVerdict openness;
  int visits = 0;    ///< how often it was flown at
  int failures = 0;  ///< how often it was given up: closed, or tried in vain
};

/// One image, and from where it was taken.
struct FacadeView {
  double stamp_sec = 0.0;
  Viewpoint from;
  std::vector<detection::SeenWindow> windows;
  std::uint32_t track_id = 0;  ///< of the one that is the target by the image; 0: none
};

/// All windows seen, in the odometry frame, each with a number of its own.
///
/// A sight belongs to the window whose place it fits (Mahalanobis distance, odometry's drift included, or
/// closer to it than another window can be), each sight to one window and each window to one sight of an
/// image, the nearest first. Two windows that come to lie in one place without ever having been seen side by
/// side are one. So neighbours of the same look stay apart, and a window is found again after a loss where it
/// was.
class FacadeMap {
 public:
  explicit FacadeMap(const FacadeParams& params) : params_(params) {}

  /// Measured, and as large as the window looked for.
  static bool isOfSize(const KnownWindow& window, const geometry::OpeningSize& looked_for);
  /// \param wall in which unknown windows are taken to lie
  /// \param looked_for size that windows are taken to have where nothing else tells their distance; what is
  /// less than half as wide or high is no window \param kept number of one that is not forgotten, and which
  /// it keeps where it turns out to be one with another
  void see(const FacadeView& view, const std::optional<Wall>& wall, const geometry::OpeningSize& looked_for,
           std::uint32_t kept = 0);
  /// A place that is better known than by one sight.
  void correct(std::uint32_t id, const WindowPlace& place);

  /// The window that one at this place is; nothing if it is none of those known.
  const KnownWindow* at(const WindowPlace& place, double stamp_sec) const;
  /// The window of the last image's target, once it has a number.
  std::optional<std::uint32_t> followed() const;
  KnownWindow* find(std::uint32_t id);
  const KnownWindow* find(std::uint32_t id) const;
  bool isConfirmed(const KnownWindow& window) const { return window.id != 0; }
  const std::vector<KnownWindow>& windows() const { return windows_; }  ///< the oldest first

 private:
  static constexpr int kMinSights = 3;  ///< images that must show a window before it has a number
  struct Sight {
    const detection::SeenWindow* seen = nullptr;
    WindowPlace place;
    std::uint32_t key = 0;  ///< of the window it belongs to
  };
  void associate(const FacadeView& view, std::vector<Sight>& sights) const;
  void learn(double stamp_sec, Sight& sight);
  void noteSideBySide(const std::vector<Sight>& sights);
  void merge(std::uint32_t kept);
  void passOnNeighbours(std::uint32_t younger, std::uint32_t older);
  void prune(const FacadeView& view, bool knows_wall, std::uint32_t kept);
  double squares(const KnownWindow& window, const WindowPlace& place, double stamp_sec) const;

  FacadeParams params_;
  std::vector<KnownWindow> windows_;
  std::set<std::pair<std::uint32_t, std::uint32_t>>
      apart_;                       // keys of those seen side by side, the lower first
  std::uint32_t followed_key_ = 0;  // 0: none
  std::uint32_t last_id_ = 0, last_key_ = 0;
};

}  // namespace window_ingress::facade
