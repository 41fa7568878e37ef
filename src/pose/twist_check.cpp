#include "window_ingress/pose/twist_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::pose {
namespace {

constexpr double kLongestGapSec = 0.5, kLongestPieceSec = 5.0;
constexpr std::size_t kMostPieces = 20;
constexpr double kMuchBetter = 0.5;

const std::array<const char*, TwistCheck::kMeanings> kNames{
    "", "twist looks like world frame, not body frame", "twist looks like x and y exchanged",
    "twist looks like y and z of opposite sign (forward-right-down)", "twist looks like the opposite sign"};

// What the velocity in odom would be, were the numbers of the twist meant like this.
std::array<Eigen::Vector3d, TwistCheck::kMeanings> meanings(const Eigen::Matrix3d& R,
                                                            const Eigen::Vector3d& velocity) {
  const Eigen::Vector3d twist = R.transpose() * velocity;
  return {velocity, twist, R * Eigen::Vector3d(twist.y(), twist.x(), twist.z()),
          R * Eigen::Vector3d(twist.x(), -twist.y(), -twist.z()), -velocity};
}

}  // namespace

void TwistCheck::add(double stamp_sec, const Eigen::Isometry3d& T_odom_base,
                     const Eigen::Vector3d& velocity_odom_mps) {
  if (!std::isfinite(stamp_sec) || !geometry::isValidPose(T_odom_base) || !velocity_odom_mps.allFinite())
    return;
  const Sample now{stamp_sec, T_odom_base.translation(), meanings(T_odom_base.linear(), velocity_odom_mps)};
  const double dt_sec = last_ ? stamp_sec - last_->stamp_sec : -1.0;
  if (dt_sec == 0.0) return;
  if (!(dt_sec > 0.0) || dt_sec > kLongestGapSec || elapsed_sec_ > kLongestPieceSec) {
    last_ = now;
    from_m_ = now.position_m;
    integrated_m_.fill(Eigen::Vector3d::Zero());
    elapsed_sec_ = 0.0;
    return;
  }
  for (int k = 0; k < kMeanings; ++k)
    integrated_m_[k] += 0.5 * dt_sec * (last_->velocity_mps[k] + now.velocity_mps[k]);
  elapsed_sec_ += dt_sec;
  last_ = now;
  const Eigen::Vector3d moved = now.position_m - from_m_;
  if (moved.norm() >= params_.way_segment_m) closePiece(moved);
}

void TwistCheck::closePiece(const Eigen::Vector3d& moved_m) {
  Piece piece{moved_m.norm(), {}};
  for (int k = 0; k < kMeanings; ++k) piece.error_m[k] = (integrated_m_[k] - moved_m).norm();
  pieces_.push_back(piece);
  if (pieces_.size() > kMostPieces) pieces_.pop_front();
  from_m_ = last_->position_m;
  integrated_m_.fill(Eigen::Vector3d::Zero());
  elapsed_sec_ = 0.0;
  judge();
}

void TwistCheck::judge() {
  double way = 0.0, squares = 0.0;
  std::array<double, kMeanings> misfit{};
  for (const Piece& piece : pieces_) {
    way += piece.way_m;
    squares += piece.way_m * piece.way_m;
    for (int k = 0; k < kMeanings; ++k) misfit[k] += piece.error_m[k] * piece.error_m[k];
  }
  if (way < params_.least_way_m) return;
  for (double& each : misfit) each = std::sqrt(each / squares);
  if (misfit[0] <= params_.max_velocity_error) {
    verdict_ = {FramesVerdict::kGood, ""};
    return;
  }
  const auto best = static_cast<std::size_t>(std::min_element(misfit.begin(), misfit.end()) - misfit.begin());
  char text[160];
  if (best > 0 && misfit[best] <= params_.max_velocity_error && misfit[best] < kMuchBetter * misfit[0])
    std::snprintf(text, sizeof text, "%s", kNames[best]);
  else
    std::snprintf(text, sizeof text, "twist does not fit the way flown: off by %.0f %%", 100.0 * misfit[0]);
  verdict_ = {FramesVerdict::kWrong, text};
}

FramesVerdict TwistCheck::verdict() const { return verdict_; }

}  // namespace window_ingress::pose
