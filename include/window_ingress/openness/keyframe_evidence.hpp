#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/openness/opening_cells.hpp"
#include "window_ingress/openness/openness_params.hpp"
#include "window_ingress/openness/plane_parallax.hpp"

namespace window_ingress::openness {

constexpr double kMaxLogOdds = 4.0;  ///< limit for one stretch

/// Result of one stretch of the flight, from a keyframe to the next.
struct KeyframeEstimate {
  double log_odds = 0.0;                      ///< open over closed, within `kMaxLogOdds`; 0: undecided
  int points = 0;                             ///< points that stand still and were seen from enough places
  int unsteady = 0;                           ///< that do not stand still
  double depth_m = 0.0, depth_sigma_m = 0.0;  ///< median of the points; both 0 without points
  bool is_too_deep = false;  ///< too many points lie deeper than any room: no evidence for an open way
  bool is_moving = false;    ///< too many points do not stand still: undecided
};

/// The points of one stretch. They share the errors of the borders, so the verdict of the stretch is that of
/// its median point, however many points there are.
class KeyframeEvidence {
 public:
  void begin(double key_stamp_sec);
  double keyStamp() const { return key_stamp_sec_; }

  /// \param through the line of sight would reach the room past the opening's inner faces
  /// \param beside cells beside the point, as in `InteriorPoint::beside`
  void see(int id, const PointParallax& parallax, bool through, std::uint64_t beside);
  /// After the points of an image. \param cells receives those of them that stand still
  KeyframeEstimate estimate(double distance_m, const OpennessParams& params, OpeningCells& cells);

 private:
  /// Evidence from one point within the opening since the keyframe. All views share the errors of the
  /// keyframe, so the best view counts, not their sum. The other views must agree with it, each for the
  /// distance flown by then; a border that jumps to another edge, or texture that moves by itself, does not.
  struct Point {
    void see(const PointParallax& parallax);
    bool isTested() const { return samples > 1; }
    bool isSteady() const;  ///< all views agree with a point that stands still; for a tested point

    static constexpr int kSamples = 6;
    PointParallax best;
    std::array<PointParallax, kSamples> ring;  ///< the newest samples, views of growing gain
    int samples = 0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< in the last view
    bool through = false, is_new = false;
    std::uint64_t beside = 0;
  };
  double key_stamp_sec_ = -1.0;
  std::vector<Point> points_;  // by the point's number
};

}  // namespace window_ingress::openness
