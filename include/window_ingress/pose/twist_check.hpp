#pragma once

#include <Eigen/Geometry>
#include <array>
#include <deque>
#include <optional>

#include "window_ingress/pose/frames_params.hpp"

namespace window_ingress::pose {

/// Compares the velocity that odometry reports with the way that it reports, piece by piece. Where they do
/// not agree, it tries other meanings of the velocity's numbers: axes of the world instead of the body's, x
/// and y exchanged, y and z mirrored, the opposite sign.
///
/// A heading within some 17 degrees of zero tells body from world too little to matter.
class TwistCheck {
 public:
  explicit TwistCheck(const FramesParams& params) : params_(params) {}

  /// \param velocity_odom_mps as computed from the reported velocity, its axes taken for the body's
  void add(double stamp_sec, const Eigen::Isometry3d& T_odom_base, const Eigen::Vector3d& velocity_odom_mps);
  void clear() { *this = TwistCheck(params_); }
  void startPiece() { last_.reset(); }  ///< what follows is no continuation of what was
  FramesVerdict verdict() const;

  static constexpr int kMeanings = 5;

 private:
  using Way = std::array<Eigen::Vector3d, kMeanings>;
  struct Sample {
    double stamp_sec;
    Eigen::Vector3d position_m;
    Way velocity_mps;
  };
  struct Piece {
    double way_m;
    std::array<double, kMeanings> error_m;
  };
  void closePiece(const Eigen::Vector3d& moved_m);
  void judge();

  FramesParams params_;
  std::optional<Sample> last_;
  Eigen::Vector3d from_m_ = Eigen::Vector3d::Zero();
  double elapsed_sec_ = 0.0;
  Way integrated_m_{};
  std::deque<Piece> pieces_;
  FramesVerdict verdict_{FramesVerdict::kOpen, "velocity: no way flown yet"};
};

}  // namespace window_ingress::pose
