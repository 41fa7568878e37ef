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

/// One image of the target, with what filter and odometry say of it.
struct OpennessView {
  const detection::WindowObservation& window;
  const geometry::PinholeCamera& camera;
  Eigen::Isometry3d T_odom_camera;
  Eigen::Isometry3d T_odom_window;  ///< as filtered
  geometry::OpeningSize opening;    ///< that goes with it
};

/// Whether the opening is open, by how the texture within it moves against the plane of its border.
///
/// The flight falls into stretches, one from each key image to the next. Within a stretch nothing adds up:
/// the best look at each point counts, its median is the stretch's word, and that word is capped. Stretches
/// do add up, for each has borders of its own; an opening is never called open or closed by a single one.
/// Open needs more: seen through all four quarters of the middle that the vehicle needs, hardly anything of
/// it closed, no deeper than a room is.
///
/// No clock, no image. The caller resets it when the odometry is another one.
class OpennessJudge {
 public:
  /// \param needed size of the middle of the opening that the vehicle needs
  /// \throws std::invalid_argument that lists every parameter out of range
  OpennessJudge(const OpennessParams& params, const geometry::OpeningSize& needed);

  /// Another `target_id` or a stamp that goes back begins anew.
  void see(const OpennessView& view);
  const OpennessVerdict& verdict() const { return verdict_; }
  void reset();

 private:
  struct Look {
    double stamp_sec;
    Eigen::Isometry3d T_odom_camera;
  };
  struct Count {
    double log_odds = 0.0;
    int open = 0, closed = 0;  ///< stretches that said so
    int moving = 0;            ///< stretches in which too much did not stand still
  };
  void close();
  void compare(const OpennessView& view, const Eigen::Isometry3d& T_odom_camera_key);
  void conclude();
  Count counted() const;
  void remember(const OpennessView& view);

  OpennessParams params_;
  geometry::OpeningSize needed_, opening_;
  std::deque<Look> looks_;
  std::uint32_t target_id_ = 0;
  KeyframeEvidence stretch_;
  StretchSays says_;
  Count past_;
  OpeningCells cells_;
  OpennessVerdict verdict_;
};

}  // namespace window_ingress::openness
