#pragma once

#include <Eigen/Geometry>
#include <array>
#include <deque>
#include <optional>

#include "window_ingress/estimation/target_estimate.hpp"

namespace window_ingress::estimation {

/// Compares the velocity from odometry with the distance flown according to odometry, piece by piece. Also
/// tests other meanings of the velocity's numbers: axes of the world instead of the body's, turned to the
/// body's twice, x and y exchanged, y and z mirrored, the opposite sign.
///
/// Positions drift, jitter and lag, so way and velocity may differ without a fault. The frame is wrong only
/// if another meaning explains the same pieces far better (a likelihood ratio of unknown noise: bad odometry
/// is equally bad for all meanings, and a scale is the same in all). If none does, the velocity is wrong only
/// if even poor odometry cannot explain the difference: odometry with strong drift, a constant velocity error
/// (fixed in the body, as estimators have it) and occasional slides.
///
/// At a heading within some 20 degrees of zero, body and world axes differ too little to matter in slow flight.
class TwistCheck {
 public:
  /// \param velocity_odom_mps computed from the reported velocity, assuming body axes
  void add(double stamp_sec, const Eigen::Isometry3d& T_odom_base, const Eigen::Vector3d& velocity_odom_mps);
  void clear() { *this = TwistCheck(); }
  void startPiece() { last_.reset(); }  ///< the next sample does not continue the last one
  FramesVerdict verdict() const { return verdict_; }
  /// Drift of the position against the velocity, root mean square per axis; that of a satellite receiver
  /// until measured [m/sqrt(s)].
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
    double way_m;          ///< by position or by velocity, whichever is longer
    double variance;       ///< of their difference per axis, for odometry with strong drift [m^2]
    double sec, turn_rad;  ///< duration; angle between body's and odometry's axes
    Way error_base_m;  ///< integrated velocity less the way flown, in the body's axes at the piece's start
  };
  struct Sums {
    double way_m = 0.0, squares = 0.0;           ///< of the way itself
    std::array<double, kMeanings> misfits = {};  ///< of the errors; all weighted by the variances
    // Of the velocity as reported:
    double own_squares = 0.0, bias_mps = 0.0;
    double error_mps = 0.0, turn_rad = 0.0;  ///< root mean square of the pieces
    double misfit() const;                   ///< relative
  };
  void startAt(const Sample& now);
  void closePiece(const Eigen::Vector3d& moved_m);
  void judge();
  Sums sums(double bias_sigma_mps) const;
  Eigen::Vector3d biasMps(int meaning) const;
  std::size_t betterMeaning(const Sums& sums, double max_misfit, double min_evidence) const;
  std::size_t betterMeaning(const Sums& all) const;

  std::optional<Sample> first_, last_;
  Way integrated_m_{};
  std::deque<Piece> pieces_;
  std::size_t accused_ = 0;  ///< meaning that a wrong verdict names; 0: none
  FramesVerdict verdict_{FramesVerdict::kUndecided, "velocity: not flown far enough yet"};
};

}  // namespace window_ingress::estimation
