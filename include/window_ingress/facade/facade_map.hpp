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

/// A window that was seen, with all that is known of it.
struct KnownWindow {
  std::uint32_t id = 0;   ///< from 1, given once enough images show it on the wall or with the target's look;
                          ///< not reused before a reset
  std::uint32_t key = 0;  ///< from 1, given at the first sight; ascending with time
  WindowPlace place;
  double last_seen_sec = 0.0;
  int sights = 0;                       ///< number of images that showed it
  double score = 0.0;                   ///< score in the last of these images, 0 to 1
  std::optional<double> bhattacharyya;  ///< smallest distance to the reference so far
  bool may_be_target = false;           ///< its look in the last image does not exclude it
  openness::OpennessVerdict openness;
  int visits = 0;    ///< number of approaches
  int failures = 0;  ///< number of times it was given up: closed, or all attempts failed

  bool isConfirmed() const { return id != 0; }
};

/// One image and its viewpoint.
struct FacadeView {
  double stamp_sec = 0.0;
  Viewpoint from;
  std::vector<detection::SeenWindow> windows;
  std::uint32_t track_id = 0;  ///< track of the target in this image; 0: none
};

/// All windows seen, in the odometry frame, each with its own number.
///
/// A sight is assigned to the window whose place it fits: by Mahalanobis distance including odometry drift,
/// or because no other window can be that close. Each sight gets one window and each window one sight per
/// image, nearest pairs first. Two windows in one place that were never seen side by side are merged. So
/// similar neighbours stay apart, and a lost window is found again at its place.
class FacadeMap {
 public:
  explicit FacadeMap(const FacadeParams& params) : params_(params) {}

  /// True if its size is measured and that of the window looked for.
  static bool isOfSize(const KnownWindow& window, const geometry::OpeningSize& looked_for);
  /// \param wall wall in which new windows are assumed to lie
  /// \param looked_for assumed size of windows whose distance is otherwise unknown; less than half as wide or
  /// high is not a window
  /// \param kept number of a window that is not forgotten, and that keeps this number in a merge
  void addView(const FacadeView& view, const std::optional<Wall>& wall,
               const geometry::OpeningSize& looked_for, std::uint32_t kept = 0);
  /// The known window at this place; null if there is none.
  const KnownWindow* at(const WindowPlace& place, double stamp_sec) const;
  /// The target in the last image, once it has a number; else null.
  KnownWindow* followed();
  KnownWindow* find(std::uint32_t id);
  const KnownWindow* find(std::uint32_t id) const;
  const std::vector<KnownWindow>& windows() const { return windows_; }  ///< the oldest first

 private:
  static constexpr int kMinSights = 3;  ///< images that must show a window before it gets a number
  struct Sight {
    const detection::SeenWindow* seen = nullptr;
    WindowPlace place;
    std::uint32_t key = 0;  ///< of the assigned window
  };
  void associate(const FacadeView& view, std::vector<Sight>& sights) const;
  void makeRoom(const std::vector<Sight>& sights, std::uint32_t kept);
  void learn(double stamp_sec, Sight& sight);
  void noteSideBySide(const std::vector<Sight>& sights);
  void merge(std::uint32_t kept);
  void passOnNeighbours(std::uint32_t younger, std::uint32_t older);
  void prune(const FacadeView& view, bool knows_wall, std::uint32_t kept);
  void forgetNeighbours();  ///< pairs of which one window is forgotten
  double squares(const KnownWindow& window, const WindowPlace& place, double stamp_sec) const;

  FacadeParams params_;
  std::vector<KnownWindow> windows_;
  /// Keys of windows seen side by side, the lower first.
  std::set<std::pair<std::uint32_t, std::uint32_t>> apart_;
  std::uint32_t followed_key_ = 0;  // 0: none
  std::uint32_t last_id_ = 0, last_key_ = 0;
};

}  // namespace window_ingress::facade
