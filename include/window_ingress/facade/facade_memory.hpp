#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "window_ingress/facade/facade_map.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::facade {

/// What is known of the tracked window after an image that was used.
struct TrackedWindow {
  Eigen::Isometry3d T_odom_window = Eigen::Isometry3d::Identity();               ///< upright
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< odom axes; m, rad
  geometry::OpeningSize size;
  bool sign_trusted = false;  ///< the window's normal is unambiguous
  int updates = 0;            ///< images that contributed since the window was last acquired
};

/// All windows seen (`FacadeMap`) and the choice of the target among them.
///
/// The target is the operator's choice, or else the first window tracked until its estimate has settled. It
/// stays the target until it is given up, until another window is clearly more like the reference, or until
/// its place was in view without it for a total of `FacadeParams::release_sec`. A target chosen by the
/// operator changes only if it is given up. While there is a target, no other window is accepted.
class FacadeMemory {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit FacadeMemory(const FacadeParams& params);

  void reset();
  /// The odometry frame changed: places are void. A chosen window stays chosen if it is still tracked;
  /// otherwise there is no target until the operator chooses again.
  void forgetPlaces();
  /// \param tracked this image's target, if the image was used
  /// \param looked_for size of the target, known or believed
  void addView(const FacadeView& view, const std::optional<TrackedWindow>& tracked,
               const geometry::OpeningSize& looked_for);

  /// Why a window seen is not the target; empty if it may be. Partial windows are not judged.
  std::string whyNotTarget(const detection::WindowObservation& window, const Viewpoint& from,
                           const geometry::OpeningSize& looked_for) const;
  /// Expected place of the target in the image (distorted pixels); nothing if it is not wholly in view.
  std::optional<geometry::Quadrilateral> expected(const Viewpoint& from) const;

  Reply select(std::uint32_t id);                         ///< 0: revokes the choice
  Reply selectNear(const Eigen::Vector3d& point_odom_m);  ///< a click on the window or next to it

  /// Windows given up by the navigator: closed, or all attempts failed. Without `next_one` nothing replaces a
  /// target chosen by the operator; any other may be replaced by a window found later.
  /// \param next_one the next best window becomes the target: like the reference, of the size looked for, not
  /// closed, never given up. If it is not there, the next one follows; if none is known, the window tracked
  /// next
  void giveUp(const std::vector<std::uint32_t>& ids, bool next_one);
  void noteFlownAt(std::uint32_t id);                    ///< 0: none
  void judge(const openness::OpennessVerdict& verdict);  ///< of the target

  const KnownWindow* target() const { return map_.find(target_id_); }
  std::uint32_t targetId() const { return target() == nullptr ? 0 : target_id_; }  ///< 0: none
  /// True if the target was chosen by the operator or as the next best, not only tracked first.
  bool isChosen() const { return is_chosen_; }
  const std::vector<KnownWindow>& windows() const { return map_.windows(); }

 private:
  void adopt(const TrackedWindow& tracked, std::uint32_t track_id);
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
  double missing_sec_ = 0.0;  ///< time in view without being seen
  std::uint32_t target_track_id_ = 0;
  bool is_chosen_ = false, is_next_ = false, choice_is_lost_ = false, choice_is_given_up_ = false;
};

}  // namespace window_ingress::facade
