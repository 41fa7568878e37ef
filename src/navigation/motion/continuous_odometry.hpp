#pragma once

#include <deque>
#include <optional>

#include "window_ingress/navigation/navigation_types.hpp"

namespace window_ingress::navigation {

/// Odometry without jumps, slides and turns: the vehicle in a frame `smooth`, in which its position follows
/// its own velocity. Over a second, position and integrated velocity of working odometry agree to a few
/// centimetres, or to their usual difference. A larger difference, beyond `kUnexplainedM` and beyond chance,
/// counts as an error of the position and is removed. Known places, above all the window, keep their position
/// relative to the vehicle. Without such errors both frames are bit-identical.
///
/// A steady velocity difference (an estimator's bias) is not a slide. A difference that outlasts any slide is
/// removed as the median of the last seconds; beyond this bias the position is believed. In the long run the
/// bias is fixed in the body; in the first seconds after a turn, in the world. The axes with the smaller
/// recent spread count. With a known bias, the velocity is corrected by its error over the last second,
/// because a velocity error changes within seconds while a position error does not run away. A heading jump
/// faster than any vehicle turns is removed. The next motion shows whether the axes of the positions have
/// turned too (estimator reset) or not (wrong attitude only).
class ContinuousOdometry {
 public:
  static constexpr double kUnexplainedM = 0.05;  ///< within one second
  static constexpr double kLongestGapSec = 0.25;

  /// Adds a sample younger than the last. \return the vehicle in `smooth`; empty after a gap longer than
  /// `kLongestGapSec` with too much motion to know the way: everything restarts with the next sample.
  std::optional<VehicleState> add(const VehicleState& odometry);
  void reset() { *this = ContinuousOdometry(); }

  /// Transform from odom to `smooth` at this time, for places measured from the vehicle: its reported pose
  /// becomes its pose in `smooth`. The places in a message belong to its stamp.
  Eigen::Isometry3d T_smooth_odom(double stamp_sec) const;
  /// Converts a velocity to the present axes of odom, in which setpoints are sent.
  Eigen::Vector3d inOdomAxes(const Eigen::Vector3d& velocity_smooth_mps) const;
  /// Error of the reported heading against the axes of the setpoints [rad]. Subtract it when setpoints are
  /// rotated into body axes.
  double headingErrorRad() const;
  /// The vehicle's velocity without its steady error, once known; axes of `smooth`.
  Eigen::Vector3d unbiased(const VehicleState& smooth) const;
  /// Steady error of the velocity [m/s], level axes with x along the nose; zero until known.
  Eigen::Vector3d biasMps() const;
  /// Difference between position and velocity over the latest two seconds [m/s]: a velocity bias, a position
  /// error, or different axes.
  double disagreementMps() const { return latePiecesMps().norm(); }
  /// Horizontal sum of all position corrections [m]: the vehicle may be this far from its place.
  double shiftM() const { return shift_m_.head<2>().norm(); }
  /// The part of `disagreementMps` that neither bias nor chance explains [m/s]. Until the bias is known, at
  /// least the possible velocity error within a second.
  double unexplainedMps() const;
  /// Random walk of position against velocity, per horizontal axis [m/sqrt(s)]; 0 until the bias is known.
  double driftMPerSqrtSec() const { return isBiasKnown() ? drift_m_per_sqrt_sec_ : 0.0; }
  bool isBiasKnown() const { return is_bias_known_; }
  /// Correction of a kept place [m], horizontal, axes of `smooth`: the vehicle followed the biased velocity
  /// while the bias could still have been a slide. Zero until the bias is known, constant afterwards.
  const Eigen::Vector3d& carriedM() const { return carried_m_; }

 private:
  static constexpr double kSecond = 1.0;
  static constexpr double kTurnJumpRad = 0.08;  ///< in one sample, beyond the vehicle's own turn
  /// Jump limits after a gap, whose way is unknown. Below the limit at which all places are forgotten
  /// (`TargetEstimator::isJump`), because a vehicle in the opening has only centimetres.
  static constexpr double kJumpInGapM = 0.2, kFastestMps = 1.0, kFastestRadps = 1.0;
  static constexpr std::size_t kPieces = 16;  ///< a slide of three seconds covers less than half of them
  /// Difference between position and velocity: of one piece of the way, or the usual one.
  struct Difference {
    Eigen::Vector3d base_mps = Eigen::Vector3d::Zero(), smooth_mps = Eigen::Vector3d::Zero();
  };
  struct Sample {
    double stamp_sec;
    Eigen::Vector3d position_m;  ///< in smooth
    Eigen::Vector3d way_m;       ///< integral of the velocity
  };
  /// Distance between the uncorrected position and the integrated velocity.
  struct Apart {
    double stamp_sec;
    Eigen::Vector3d apart_m;
  };
  struct Frame {
    double stamp_sec;
    Eigen::Isometry3d T_smooth_odom;
  };
  /// Pending question whether the position axes have turned with the heading.
  struct Turn {
    double turn_rad;
    Sample piece;          ///< start of the present piece of the way, in the reported axes
    int pieces = 0;        ///< number of pieces so far
    double told_m2 = 0.0;  ///< sum of the squared distances between both answers
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
  /// Largest random difference between position and velocity beyond the bias in this time, from the past [m].
  double byChanceM(double passed_sec) const;
  void shiftIfUnexplained(VehicleState& smooth);
  void noteFrame();

  std::optional<VehicleState> odometry_, smooth_;
  Eigen::Isometry3d T_smooth_axes_ = Eigen::Isometry3d::Identity();  ///< transform of the reported positions
  std::deque<Frame> frames_;  ///< recent frames; empty: no error so far
  std::deque<Sample> second_;
  std::optional<Turn> turn_;
  double heading_error_rad_ = 0.0;
  bool is_erring_ = false;  ///< odom and `smooth` differ
  bool is_bias_known_ = false;
  Eigen::Vector3d way_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d shift_m_ = Eigen::Vector3d::Zero();    ///< total position correction
  std::optional<Apart> apart_;                           ///< now, averaged because a single sample may be off
  std::optional<Apart> piece_;                           ///< start of the present piece of the way
  std::deque<Sample> differences_;                       ///< last second, uncorrected positions
  std::deque<Difference> pieces_;                        ///< latest pieces
  Difference usual_;                                     ///< median of `pieces_`
  Eigen::Vector3d carried_m_ = Eigen::Vector3d::Zero();  ///< see `carriedM`
  Axes axes_ = &Difference::base_mps;                    ///< axes in which `pieces_` spread less
  double drift_m_per_sqrt_sec_ = 0.0;                    ///< random walk, from pieces of half a second
  double in_second_m_ = 0.0;  ///< difference within a second, per axis: large if velocity errors last
};

}  // namespace window_ingress::navigation
