#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/openness/keyframe_evidence.hpp"
#include "window_ingress/openness/opening_cells.hpp"
#include "window_ingress/openness/openness_params.hpp"
#include "window_ingress/openness/openness_verdict.hpp"

namespace window_ingress::openness {

/// One image of the target with its poses from filter and odometry.
struct OpennessView {
  const detection::WindowObservation& window;
  const geometry::PinholeCamera& camera;
  Eigen::Isometry3d T_odom_camera;
  Eigen::Isometry3d T_odom_window;  ///< from the filter
  geometry::OpeningSize opening;    ///< its size in the filter
};

/// Decides whether the opening is open, by the motion of the texture within it against the border's plane.
///
/// The flight consists of stretches, each from a keyframe to the next. Within a stretch evidence is not
/// summed: the best view of each point counts, and the stretch's verdict is their median, limited in size.
/// Stretches are summed, because each has its own borders; a single one never decides. OPEN also needs: depth
/// seen through all four quarters of the middle that the vehicle needs, hardly anything of it closed, and no
/// depth beyond that of a room.
///
/// No clock, no image. The caller resets it when the odometry frame changes.
class OpennessJudge {
 public:
  /// \param needed size of the middle of the opening that the vehicle needs
  /// \throws std::invalid_argument that lists every parameter out of range
  OpennessJudge(const OpennessParams& params, const geometry::OpeningSize& needed);

  /// Another `target_id` or a stamp that goes back starts anew.
  void see(const OpennessView& view);
  const OpennessVerdict& verdict() const { return verdict_; }
  void reset();

 private:
  struct View {
    double stamp_sec;
    Eigen::Isometry3d T_odom_camera;
  };
  struct Count {
    double log_odds = 0.0;
    int open = 0, closed = 0;  ///< stretches with this verdict
    int moving = 0;            ///< stretches in which too many points moved
  };
  void compare(const OpennessView& view, const Eigen::Isometry3d& T_odom_camera_key);
  void conclude();
  Count counted() const;

  OpennessParams params_;
  geometry::OpeningSize needed_, opening_;
  std::deque<View> views_;
  std::uint32_t target_id_ = 0;
  KeyframeEvidence evidence_;
  KeyframeEstimate estimate_;
  Count past_;
  OpeningCells cells_;
  OpennessVerdict verdict_;
};

}  // namespace window_ingress::openness
