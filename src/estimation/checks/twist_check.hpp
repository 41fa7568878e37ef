#pragma once

#include <Eigen/Geometry>
#include <array>
#include <deque>
#include <optional>

#include "window_ingress/estimation/frames_verdict.hpp"

namespace window_ingress::estimation {

/// Compares the velocity that odometry reports with the way that it reports, piece by piece, and with other
/// meanings of the velocity's numbers: axes of the world instead of the body's, turned to the body's twice, x
/// and y exchanged, y and z mirrored, the opposite sign.
///
/// Positions drift, jitter and lag, and then way and velocity differ without any fault. So a frame is a fault
/// only where another meaning explains the very same pieces, and far better (a likelihood ratio of unknown
/// noise: bad odometry is as bad for all meanings, and a scale is the same in all of them). Where none does,
/// the velocity is a fault only if even odometry that drifts much, has a velocity that is always off by the
/// same (fixed in the body, as estimators have it) and slides now and then cannot explain the difference.
///
/// A heading within some 17 degrees of zero tells body from world too little to matter.
class TwistCheck {
 public:
  /// \param velocity_odom_mps as computed from the reported velocity, its axes taken for the body's
  void add(double stamp_sec, const Eigen::Isometry3d& T_odom_base, const Eigen::Vector3d& velocity_odom_mps);
  void clear() { *this = TwistCheck(); }
  void startPiece() { last_.reset(); }  ///< what follows is no continuation of what was
  FramesVerdict verdict() const { return verdict_; }
  /// How fast the position walks beside the velocity, root mean square of an axis; that of a satellite
  /// receiver before it is known [m/sqrt(s)].
  double driftMPerSqrtSec() const;

  static constexpr int kMeanings = 6;

 private:
  using Way = std::array<Eigen::Vector3d, kMeanings>;
  struct Sample {
    double stamp_sec;
    Eigen::Matrix3d R_odom_base;
    Eigen::Vector3d position_m;
    Way velocity_mps;
  };
  struct Piece {
    double way_m;     ///< by position or by velocity, whichever is longer
    double variance;  ///< of their difference, each axis, were odometry to drift much [m^2]
    double sec;
    Way error_base_m;  ///< integrated velocity less the way flown, in the body's axes at the piece's start
  };
  struct Sums {
    double way_m = 0.0, squares = 0.0;           ///< of the way itself
    std::array<double, kMeanings> misfits = {};  ///< of the errors; all weighted by the variances
    double bias_mps = 0.0;                       ///< of the velocity as it was taken
    double misfit() const;                       ///< relative, of the velocity as it was taken
  };
  void startAt(const Sample& now);
  void closePiece(const Eigen::Vector3d& moved_m);
  void judge();
  Sums sums() const;
  Eigen::Vector3d biasMps(int meaning) const;
  std::size_t betterMeaning(const Sums& sums) const;

  std::optional<Sample> first_, last_;
  Way integrated_m_{};
  std::deque<Piece> pieces_;
  std::size_t accused_ = 0;  ///< meaning that a wrong verdict names; 0: none
  FramesVerdict verdict_{FramesVerdict::kOpen, "velocity: no way flown yet"};
};

}  // namespace window_ingress::estimation
