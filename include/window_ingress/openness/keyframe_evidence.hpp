#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/openness/opening_cells.hpp"
#include "window_ingress/openness/openness_params.hpp"
#include "window_ingress/openness/plane_parallax.hpp"

namespace window_ingress::openness {

/// Ranges of D / (d + D) for a closed and an open way, seen from a distance d.
struct DepthParts {
  double closed_from, closed_to;  ///< next to the plane: a surface that closes it
  double open_from, open_to;      ///< a room

  static DepthParts at(double distance_m, const OpennessParams& params);
  /// Log likelihood of the nearest open depth over that of the nearest closed one.
  double logOdds(double part, double sigma) const;
};

/// Evidence from one point within the opening since its keyframe. All views share the errors of the keyframe,
/// so the best view counts, not their sum. The other views must agree with it, each for the distance flown by
/// then; a border that jumps to another edge, or texture that moves by itself, does not.
class TrackEvidence {
 public:
  void see(const PointParallax& parallax);
  const PointParallax& best() const { return best_; }
  const PointParallax& last() const { return last_; }
  /// All views agree with a point that stands still.
  bool isSteady(double max_sigmas) const;
  bool isTested() const { return samples_ > 1; }

 private:
  static constexpr int kSamples = 6;
  static constexpr double kGrowth = 1.25;  ///< of the gain, from sample to sample
  struct Sample {
    double part, sigma, gain_px;
  };
  PointParallax best_, last_;
  int views_ = 0, samples_ = 0;
  std::array<Sample, kSamples> ring_{};
};

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
  /// Enters the points that stand still into the cells.
  void mark(const DepthParts& parts, OpeningCells& cells);
  KeyframeEstimate estimate(const DepthParts& parts, double distance_m, const OpennessParams& params) const;

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
