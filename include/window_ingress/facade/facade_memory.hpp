#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "window_ingress/estimation/window_filter.hpp"
#include "window_ingress/facade/facade_map.hpp"

namespace window_ingress::facade {

/// An answer to a request: never silent.
struct Answer {
  bool success = false;
  std::string message;
};

/// All windows seen (`FacadeMap`), and which of them is the target.
///
/// The target is the one that the operator chose, else the window that was followed until the filter had
/// settled. It stays the target until it is given up, until another one is clearly more like the reference,
/// or until its place was in view without it for `FacadeParams::release_sec` in all; one that the operator
/// chose only if it is given up. While there is one, no other window is taken for it.
class FacadeMemory {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit FacadeMemory(const FacadeParams& params);

  void reset();
  /// The odometry frame is another one: places are void. A window that was chosen stays so if it is followed
  /// on; else nothing is the target until one is chosen again.
  void forgetPlaces();
  /// \param filtered what the filter knows of the window that is the target in this image, if it was used
  /// \param looked_for size of the target, known or believed
  void see(const FacadeView& view, const std::optional<estimation::FilteredWindow>& filtered,
           const geometry::OpeningSize& looked_for);

  /// Why a window seen is not the target; empty if it may be. One that is not whole is not judged.
  std::string whyNotTarget(const detection::WindowObservation& window, const Viewpoint& from,
                           const geometry::OpeningSize& looked_for) const;
  /// Where in the image the target must be, as it comes (distorted); nothing if it is not wholly in view.
  std::optional<geometry::Quadrilateral> expected(const Viewpoint& from) const;

  Answer select(std::uint32_t id);                         ///< 0: none is chosen any more
  Answer selectNear(const Eigen::Vector3d& point_odom_m);  ///< a click on it, or beside it

  /// Windows given up by who flies: closed, or tried in vain. Without `next_one` nothing takes the place of
  /// one that the operator chose; else another one that is found may. \param next_one the next best becomes
  /// the target: like the reference, of the size looked for, not closed, never given up. If it turns out not
  /// to be there, the next; where none is known, the one that the detector follows next
  void giveUp(const std::vector<std::uint32_t>& ids, bool next_one);
  void noteFlownAt(std::uint32_t id);                    ///< 0: none
  void judge(const openness::OpennessVerdict& verdict);  ///< of the target

  const KnownWindow* target() const { return map_.find(target_id_); }
  std::uint32_t targetId() const { return target() == nullptr ? 0 : target_id_; }  ///< 0: none
  /// The target was chosen, by the operator or as the next best; it is not just the one that was followed.
  bool isChosen() const { return is_chosen_; }
  bool isShown(const KnownWindow& window) const { return map_.isConfirmed(window); }
  const std::vector<KnownWindow>& windows() const { return map_.windows(); }

 private:
  void adopt(const estimation::FilteredWindow& filtered, std::uint32_t track_id);
  void yieldToBetterLook();
  void releaseIfGone(const FacadeView& view);
  void setTarget(std::uint32_t id, bool is_chosen);
  void setNextBest();
  const KnownWindow* nextBest() const;

  FacadeParams params_;
  FacadeMap map_;
  std::optional<Wall> wall_;
  std::uint32_t target_id_ = 0, flown_at_ = 0;
  geometry::OpeningSize looked_for_;
  std::optional<double> last_view_sec_;
  double missing_sec_ = 0.0;  ///< in view, and not seen
  std::uint32_t target_track_id_ = 0;
  bool is_chosen_ = false, is_next_ = false, choice_is_lost_ = false, choice_is_given_up_ = false;
};

}  // namespace window_ingress::facade
