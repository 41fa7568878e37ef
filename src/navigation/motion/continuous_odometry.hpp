#pragma once

#include <deque>
#include <optional>

#include "window_ingress/navigation/navigation_types.hpp"

namespace window_ingress::navigation {

/// Odometry without its jumps, slides and turns: the vehicle in a frame `smooth`, in which it moves as its
/// own velocity says. Over a second, position and integrated velocity of an odometry that works agree to a
/// few centimetres, or to what they were seen to differ by; what goes beyond both `kUnexplainedM` and chance
/// is taken for an error of the position and taken off. Places that were known before (the window, above all)
/// stay where they are beside the vehicle. Without such errors both frames are the same to the bit.
///
/// A steady difference of the velocity (an estimator's bias) is no slide: what has lasted for longer than one
/// is taken off, the middle value of the last seconds, and beside it the position is believed. It is fixed in
/// the body in the long run, and stays as it was in the world for the first seconds after a turn: what has
/// been more even of late counts. Of the velocity, what it was off by in the last second is taken off then: a
/// velocity that errs errs otherwise within seconds, and a position that errs does not run away. A heading
/// that turns faster than any vehicle is corrected by the turn; whether the axes of the positions have turned
/// along (the estimator was reset) or not (its attitude alone is wrong) the next motion shows.
class ContinuousOdometry {
 public:
  static constexpr double kUnexplainedM = 0.05;  ///< within a second
  static constexpr double kLongestGapSec = 0.25;

  /// A sample younger than the one before. \return the vehicle in `smooth`; nothing if it went too far in a
  /// gap longer than `kLongestGapSec` for anybody to know the way: everything starts anew from the next
  /// sample.
  std::optional<VehicleState> add(const VehicleState& odometry);
  void reset() { *this = ContinuousOdometry(); }

  /// From odom as it was at that time into `smooth`, for what is known from beside the vehicle: the vehicle's
  /// reported pose becomes its pose there. The places in a message belong to its stamp.
  Eigen::Isometry3d T_smooth_odom(double stamp_sec) const;
  /// A velocity in the axes that whoever gets the setpoints has now.
  Eigen::Vector3d inOdomAxes(const Eigen::Vector3d& velocity_smooth_mps) const;
  /// By how much the reported heading is turned against the axes of the setpoints [rad]: to be taken off
  /// where setpoints are turned into body axes.
  double headingErrorRad() const;
  /// The vehicle's velocity without its steady error, once that is known; axes of `smooth`.
  Eigen::Vector3d unbiased(const VehicleState& smooth) const;
  /// That error: of the velocity, level axes with x along the nose [m/s]; zero until it is known.
  Eigen::Vector3d biasMps() const;
  /// What position and velocity differ by, over the latest two seconds [m/s]: a bias of the velocity, an
  /// error of the position, or axes that are not those of the other.
  double disagreementMps() const { return latePiecesMps().norm(); }
  /// By how much positions were set right so far, level [m]: the vehicle may stand as far from its place.
  double shiftM() const { return shift_m_.head<2>().norm(); }
  /// What of it neither the known bias nor chance explains [m/s]; before one is known, what the velocity may
  /// be off by within a second, if that is more.
  double unexplainedMps() const;
  /// How its position walks beside its velocity, each horizontal axis [m/sqrt(s)]; 0 until the bias is known.
  double driftMPerSqrtSec() const { return isBiasKnown() ? drift_m_per_sqrt_sec_ : 0.0; }
  bool isBiasKnown() const { return is_bias_known_; }
  /// The way by which a vehicle that kept its place was carried off, back [m], level, axes of `smooth`: while
  /// a bias might have been a slide, the velocity was believed. Zero until it is known, the same ever after.
  const Eigen::Vector3d& carriedM() const { return carried_m_; }

 private:
  static constexpr double kSecond = 1.0;
  static constexpr double kTurnJumpRad = 0.08;  ///< in one sample, beside what a vehicle turns
  /// After a gap, in which the way is not known: less than what ends all places (`TargetEstimator::isJump`),
  /// because a vehicle in the opening has only centimetres.
  static constexpr double kJumpInGapM = 0.2, kFastestMps = 1.0, kFastestRadps = 1.0;
  static constexpr std::size_t kPieces = 16;  ///< a slide of three seconds is a minority of them
  /// What position and velocity differ by, as of one piece of the way or as usual.
  struct Difference {
    Eigen::Vector3d base_mps = Eigen::Vector3d::Zero(), smooth_mps = Eigen::Vector3d::Zero();
  };
  struct Sample {
    double stamp_sec;
    Eigen::Vector3d position_m;  ///< in smooth
    Eigen::Vector3d way_m;       ///< integrated velocity
  };
  /// What the position, without shifts, and the integrated velocity are apart by.
  struct Apart {
    double stamp_sec;
    Eigen::Vector3d apart_m;
  };
  struct Frame {
    double stamp_sec;
    Eigen::Isometry3d T_smooth_odom;
  };
  /// Have the axes turned with the heading?
  struct Turn {
    double turn_rad;
    Sample piece;          ///< where the present piece of the way began, in the axes that odometry reports
    int pieces = 0;        ///< of the way, so far
    double told_m2 = 0.0;  ///< squares of what lies between the two answers, piece by piece
    double misfit_m2 = 0.0, misfit_turned_m2 = 0.0;
  };

  static Eigen::Matrix3d uprightOf(const VehicleState& vehicle);
  VehicleState inSmooth(const VehicleState& odometry) const;
  bool headingComesBack(double turned_rad) const;
  void judgeTurn(const VehicleState& odometry);
  void learnBias(const VehicleState& smooth);
  using Axes = Eigen::Vector3d Difference::*;
  Eigen::Vector3d middleMps(Axes axes) const;
  Eigen::Vector3d latePiecesMps() const;
  void judgePieces();
  void judgeBias();
  Eigen::Vector3d usualMps(const Eigen::Matrix3d& R_smooth_base) const;
  Eigen::Vector3d steadyMps(const Eigen::Matrix3d& R_smooth_base) const;
  /// Beside the bias, position and velocity go apart by no more within that time, as they did so far [m].
  double byChanceM(double passed_sec) const;
  void shiftIfUnexplained(VehicleState& smooth);
  void noteFrame();

  std::optional<VehicleState> odometry_, smooth_;
  Eigen::Isometry3d T_smooth_axes_ =
      Eigen::Isometry3d::Identity();  ///< of the positions that odometry reports
  std::deque<Frame> frames_;          ///< of late; empty: no error so far
  std::deque<Sample> second_;
  std::optional<Turn> turn_;
  double heading_error_rad_ = 0.0;
  bool is_erring_ = false;  ///< the two frames differ
  bool is_bias_known_ = false;
  Eigen::Vector3d way_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d shift_m_ = Eigen::Vector3d::Zero();    ///< of the frame, so far
  std::optional<Apart> apart_;                           ///< now, averaged: one sample may be off
  std::optional<Apart> piece_;                           ///< where the present piece of the way began
  std::deque<Sample> differences_;                       ///< of the last second, positions without shifts
  std::deque<Difference> pieces_;                        ///< the latest
  Difference usual_;                                     ///< middle value of them
  Eigen::Vector3d carried_m_ = Eigen::Vector3d::Zero();  ///< against what the velocity said
  Axes axes_ = &Difference::base_mps;                    ///< in which they are more even
  double drift_m_per_sqrt_sec_ = 0.0;                    ///< as a walk, by half seconds
  double in_second_m_ = 0.0;  ///< apart, each axis: more than the walk makes where a velocity errs for longer
};

}  // namespace window_ingress::navigation
