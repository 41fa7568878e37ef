#pragma once

#include <cstdint>
#include <vector>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/openness/opening_cells.hpp"
#include "window_ingress/openness/track_evidence.hpp"

namespace window_ingress::openness {

constexpr double kMaxLogOdds = 4.0;  ///< that one stretch may bring

/// What one stretch of the flight, from a key image to the next, says.
struct StretchSays {
  double log_odds = 0.0;                      ///< open over closed, within `kMaxLogOdds`; 0: nothing
  int points = 0;                             ///< that stand still and were seen from places enough
  int unsteady = 0;                           ///< that do not stand still
  int too_deep = 0;                           ///< that lie behind any room
  double depth_m = 0.0, depth_sigma_m = 0.0;  ///< median of the points; both 0 without any
  bool is_too_deep = false;  ///< so much of it lies behind any room that it does not speak for an open way
  bool is_moving = false;    ///< so much does not stand still that nothing is said
};

/// The points of one stretch. Errors of the borders are common to all of them: the verdict of the stretch is
/// that of its median point, however many there are.
class KeyframeEvidence {
 public:
  void begin(double key_stamp_sec);
  double keyStamp() const { return key_stamp_sec_; }

  /// \param through for each point: its sight would reach the room past the opening's inner faces
  /// \param beside cells beside it, as in `InteriorPoint::beside`
  void see(int id, const PointParallax& look, bool through, std::uint64_t beside);
  /// Takes what a point showed into the cells, if it stands still.
  void mark(const DepthParts& parts, OpeningCells& cells);
  StretchSays says(const DepthParts& parts, double distance_m, const OpennessParams& params) const;

 private:
  struct Entry {
    TrackEvidence track;
    bool through = false, current = false;
    std::uint64_t beside = 0;
  };
  double key_stamp_sec_ = -1.0;
  std::vector<Entry> entries_;  // by the point's number
};

}  // namespace window_ingress::openness
