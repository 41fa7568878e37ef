#pragma once

#include <array>

#include "window_ingress/openness/openness_params.hpp"
#include "window_ingress/openness/plane_parallax.hpp"

namespace window_ingress::openness {

/// Parts D / (d + D) that a closed and an open way have, seen from a distance d.
struct DepthParts {
  double closed_from, closed_to;  ///< next to the plane: a surface that closes it
  double open_from, open_to;      ///< a room

  static DepthParts at(double distance_m, const OpennessParams& params);
  /// Log likelihood of the nearest open depth over that of the nearest closed one.
  double logOdds(double part, double sigma) const;
};

/// What one point within the opening has shown since its key image. All of it bears the same errors of the
/// key image, so the best look counts and no sum of looks; the others must agree with it, each by the way
/// that had been flown by then. A border that jumps to another edge, or texture that moves by itself, does
/// not.
class TrackEvidence {
 public:
  void see(const PointParallax& look);
  bool empty() const { return looks_ == 0; }
  const PointParallax& best() const { return best_; }
  const PointParallax& last() const { return last_; }
  /// Seen from two places at least that tell, and all of it agrees with a point that stands still.
  bool isSteady(double max_sigmas) const;
  bool isTested() const { return samples_ > 1; }

 private:
  static constexpr int kSamples = 6;
  static constexpr double kGrowth = 1.25;  ///< of the gain from sample to sample
  struct Sample {
    double part, sigma, gain_px;
  };
  PointParallax best_, last_;
  int looks_ = 0, samples_ = 0;
  std::array<Sample, kSamples> ring_{};
};

}  // namespace window_ingress::openness
