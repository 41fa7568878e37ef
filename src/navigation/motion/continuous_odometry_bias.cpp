// Bias of an odometry's velocity.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "navigation/motion/continuous_odometry.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/median.hpp"

namespace window_ingress::navigation {
namespace {

constexpr double kPieceSec = 0.5, kNoticeableMps = 0.03, kMaxBiasMps = 0.4;
constexpr double kMaxErrorMps = 0.5;  // limit of any velocity error while the bias is unknown
constexpr std::size_t kLatePieces = 4, kFirstPieces = 2;
constexpr std::size_t kSteadyPieces = 8;              // longer than a slide lasts
constexpr double kAlikeMps = 0.1, kAlikeShare = 0.5;  // of the bias: limit for alike pieces
constexpr double kMoreEven = 0.8;                     // factor on the squared spread in the other axes
constexpr double kSigmas = 2.0;           // of the position's random walk, while the bias is unknown
constexpr double kOfNewest = 0.4;         // weight of the newest sample in the average: one sample may be off
constexpr double kMostSigmas = 7.0;       // of the difference within a second; more is not chance
constexpr double kSigmaOfMedian = 0.849;  // per axis, of the median length of plane normal vectors

}  // namespace

Eigen::Matrix3d ContinuousOdometry::uprightOf(const VehicleState& vehicle) {
  return geometry::yawRotation(geometry::yawOf(vehicle.T_odom_base.linear()));
}

// Learns a steady error of the velocity.
void ContinuousOdometry::learnBias(const VehicleState& smooth) {
  const Eigen::Vector3d unshifted_m = smooth.T_odom_base.translation() - shift_m_;
  differences_.push_back({smooth.stamp_sec, unshifted_m, way_m_});
  while (differences_.front().stamp_sec < smooth.stamp_sec - kSecond) differences_.pop_front();
  const Apart now{smooth.stamp_sec, unshifted_m - way_m_};
  if (!apart_) apart_ = piece_ = now;
  apart_->stamp_sec += kOfNewest * (now.stamp_sec - apart_->stamp_sec);
  apart_->apart_m += kOfNewest * (now.apart_m - apart_->apart_m);
  const double piece_sec = apart_->stamp_sec - piece_->stamp_sec;
  if (piece_sec < kPieceSec) return;
  const Eigen::Vector3d differs_mps = (apart_->apart_m - piece_->apart_m) / piece_sec;
  pieces_.push_back({uprightOf(smooth).transpose() * differs_mps, differs_mps});
  if (pieces_.size() > kPieces) pieces_.pop_front();
  piece_ = apart_;
  if (pieces_.size() >= kFirstPieces) judgePieces();
  if (!is_bias_known_) judgeBias();
}

void ContinuousOdometry::judgePieces() {
  const Difference middle{middleMps(&Difference::base_mps), middleMps(&Difference::smooth_mps)};
  usual_ = middle;
  for (Eigen::Vector3d* usual_mps : {&usual_.base_mps, &usual_.smooth_mps})
    if (usual_mps->norm() > kMaxBiasMps) *usual_mps *= kMaxBiasMps / usual_mps->norm();
  // Lengths of the sums of so many pieces in a row, less the median.
  const auto besides = [&](Axes axes, std::size_t in_a_row) {
    std::vector<double> lengths_mps;
    for (std::size_t last = in_a_row - 1; last < pieces_.size(); ++last) {
      Eigen::Vector3d sum_mps = pieces_[last].*axes;
      for (std::size_t before = 1; before < in_a_row; ++before) sum_mps += pieces_[last - before].*axes;
      sum_mps -= static_cast<double>(in_a_row) * middle.*axes;
      lengths_mps.push_back(sum_mps.head<2>().norm());
    }
    return lengths_mps;
  };
  const auto squared = [](const std::vector<double>& v) {
    return std::inner_product(v.begin(), v.end(), v.begin(), 0.0);
  };
  const auto lesserMedian = [](std::vector<double> a, std::vector<double> b) {
    return std::min(geometry::median(a), geometry::median(b));
  };
  const auto in_body_mps = besides(&Difference::base_mps, 1),
             in_world_mps = besides(&Difference::smooth_mps, 1);
  const bool is_fixed_in_world = squared(in_world_mps) < kMoreEven * squared(in_body_mps);
  axes_ = is_fixed_in_world ? &Difference::smooth_mps : &Difference::base_mps;
  drift_m_per_sqrt_sec_ = kSigmaOfMedian * lesserMedian(in_body_mps, in_world_mps) * std::sqrt(kPieceSec);
  in_second_m_ = kSigmaOfMedian * kPieceSec *
                 lesserMedian(besides(&Difference::base_mps, 2), besides(&Difference::smooth_mps, 2));
}

// The bias is known once all pieces are there (median), or once more are alike than any slide lasts.
void ContinuousOdometry::judgeBias() {
  const Eigen::Vector3d usual_mps = usual_.*axes_;
  const double alike_mps = std::max(kAlikeMps, kAlikeShare * usual_mps.head<2>().norm());
  std::size_t alike = 0;
  Eigen::Vector3d carried_m = Eigen::Vector3d::Zero();
  for (const Difference& piece : pieces_) {
    if ((piece.*axes_ - usual_mps).head<2>().norm() > alike_mps) continue;
    ++alike;
    carried_m.head<2>() -= kPieceSec * piece.smooth_mps.head<2>();
  }
  is_bias_known_ = pieces_.size() == kPieces || alike >= kSteadyPieces;
  if (is_bias_known_ && is_erring_) carried_m_ = carried_m;
}

// In axes of `smooth`; zero while the difference may be a slide.
Eigen::Vector3d ContinuousOdometry::usualMps(const Eigen::Matrix3d& R_smooth_base) const {
  if (!isBiasKnown()) return Eigen::Vector3d::Zero();
  return axes_ == &Difference::smooth_mps ? usual_.smooth_mps
                                          : Eigen::Vector3d(R_smooth_base * usual_.base_mps);
}

// The last second counts, because a velocity error changes within seconds.
Eigen::Vector3d ContinuousOdometry::steadyMps(const Eigen::Matrix3d& R_smooth_base) const {
  if (isBiasKnown() && !differences_.empty()) {
    const Sample &first = differences_.front(), &last = differences_.back();
    const double passed_sec = last.stamp_sec - first.stamp_sec;
    if (passed_sec > kPieceSec)
      return (last.position_m - first.position_m - last.way_m + first.way_m) / passed_sec;
  }
  return usualMps(R_smooth_base);
}

Eigen::Vector3d ContinuousOdometry::biasMps() const {
  if (!smooth_) return Eigen::Vector3d::Zero();
  const Eigen::Matrix3d R_smooth_base = uprightOf(*smooth_);
  return -(R_smooth_base.transpose() * steadyMps(R_smooth_base));
}

Eigen::Vector3d ContinuousOdometry::middleMps(Axes axes) const {
  std::vector<Eigen::Vector3d> pieces_mps;
  for (const Difference& piece : pieces_) pieces_mps.push_back(piece.*axes);
  return geometry::componentwiseMedian(pieces_mps);
}

Eigen::Vector3d ContinuousOdometry::latePiecesMps() const {
  if (pieces_.size() < kLatePieces) return usual_.*axes_;
  Eigen::Vector3d sum_mps = Eigen::Vector3d::Zero();
  std::for_each(pieces_.end() - kLatePieces, pieces_.end(),
                [&](const auto& piece) { sum_mps += piece.*axes_; });
  return sum_mps / kLatePieces;
}

double ContinuousOdometry::byChanceM(double passed_sec) const {
  const double by_chance_m = kMostSigmas * in_second_m_ * std::sqrt(passed_sec / kSecond);
  if (isBiasKnown()) return by_chance_m;
  return std::min(by_chance_m, kMaxErrorMps * passed_sec);  // the first pieces may mostly be a slide
}

double ContinuousOdometry::unexplainedMps() const {
  if (isBiasKnown()) {
    constexpr double kLateSec = kLatePieces * kPieceSec;
    const double beside_bias_mps = (latePiecesMps() - usual_.*axes_).norm();
    return kLateSec * beside_bias_mps < byChanceM(kLateSec) ? 0.0 : beside_bias_mps;
  }
  if (pieces_.empty()) return 0.0;
  const double walk_mps = drift_m_per_sqrt_sec_ / std::sqrt(kSecond);
  return std::max(latePiecesMps().norm(), std::hypot((usual_.*axes_).norm(), kSigmas * walk_mps));
}

Eigen::Vector3d ContinuousOdometry::unbiased(const VehicleState& smooth) const {
  const Eigen::Vector3d steady_mps = steadyMps(uprightOf(smooth));
  if (steady_mps.norm() < kNoticeableMps) return smooth.velocity_odom_mps;
  return smooth.velocity_odom_mps + steady_mps;
}

}  // namespace window_ingress::navigation
