#include "estimation/checks/twist_check.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/median.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kMaxPieceGapSec = 0.5, kShortestPieceSec = 0.5, kLongestPieceSec = 5.0;
constexpr double kPieceM = 0.25, kMinWayM = 0.5;  // way of a piece; way before a verdict
constexpr double kMaxVelocityMisfit = 0.3;        // relative, of way and velocity
constexpr double kMaxOtherMisfit = 0.4;           // relative misfit of the meaning named instead
constexpr std::size_t kMaxPieces = 24;
constexpr std::size_t kMinPieces = 14;  // to refute; a slide of three seconds affects a minority of them
constexpr double kFirstDriftMPerSqrtSec = 0.05, kFirstDriftAxes = 6.0;  // prior: satellite navigation
constexpr double kMaxBiasMps = 0.42;  // satellite navigation: 0.3 m/s, and its positions drift meanwhile
constexpr double kBiasSigmaMps = 0.07, kNoBiasMps = 1e-6;  // prior of the bias, each axis
// Odometry with strong drift: jitter, random walk, scale error, velocity late against the position.
constexpr double kJitterM = 0.02, kVelocityDriftMPerSqrtSec = 0.07, kScale = 0.1, kLateSec = 0.15;
// Of one piece: outliers and slides are no frame error. More counts where no other meaning is compared.
constexpr double kMaxSquares = 9.0, kMaxOwnSquares = 30.0;
// Of normalised errors; 1 is expected. Satellite navigation, whose velocity wanders by 0.12 m/s, reached 4.6.
constexpr double kMaxMeanSquares = 4.8;
constexpr double kLeastMeanSquares = 0.2;    // floor for comparing meanings: a smaller misfit is chance
constexpr double kOtherMeaningBetter = 0.5;  // of the reported meaning's squares, for another meaning
constexpr double kMinEvidence = 12.0;        // for another meaning [nats]
// Exact odometry: the other meaning fits better than a bias could make it.
constexpr double kMaxExactMisfit = 0.15, kMinExactEvidence = 8.0;
// Axes turned by a small heading look like a velocity that is off to the side for some seconds, as a
// satellite receiver's is. Within this turn so small an error is no proof of them.
constexpr double kSmallTurnRad = 0.38, kLeastTurnedErrorMps = 0.2;
constexpr std::size_t kLastTurned = 2;  // meaning; the one before it is turned by the heading, too

const std::array<const char*, TwistCheck::kMeanings> kNames{
    "",
    "twist looks like world frame, not body frame",
    "twist looks rotated into the body frame twice",
    "twist looks like x and y exchanged",
    "twist looks like y and z of opposite sign (forward-right-down)",
    "twist looks like the opposite sign"};

// The velocity in odom for each meaning of the twist's numbers.
std::array<Eigen::Vector3d, TwistCheck::kMeanings> meanings(const Eigen::Matrix3d& R,
                                                            const Eigen::Vector3d& velocity) {
  const Eigen::Vector3d twist = R.transpose() * velocity;
  return {velocity,
          twist,
          R * velocity,
          R * Eigen::Vector3d(twist.y(), twist.x(), twist.z()),
          R * Eigen::Vector3d(twist.x(), -twist.y(), -twist.z()),
          -velocity};
}

double square(double value) { return value * value; }

}  // namespace

void TwistCheck::add(double stamp_sec, const Eigen::Isometry3d& T_odom_base,
                     const Eigen::Vector3d& velocity_odom_mps) {
  if (!std::isfinite(stamp_sec) || !geometry::isValidPose(T_odom_base) || !velocity_odom_mps.allFinite())
    return;
  const Eigen::Matrix3d R = T_odom_base.linear();
  const Sample now{stamp_sec, R, T_odom_base.translation(), meanings(R, velocity_odom_mps)};
  const double dt_sec = last_ ? stamp_sec - last_->stamp_sec : -1.0;
  if (dt_sec == 0.0) return;
  const bool continues = dt_sec > 0.0 && dt_sec <= kMaxPieceGapSec;
  if (!continues || last_->stamp_sec - first_->stamp_sec > kLongestPieceSec) return startAt(now);
  for (int k = 0; k < kMeanings; ++k)
    integrated_m_[k] += 0.5 * dt_sec * (last_->velocity_mps[k] + now.velocity_mps[k]);
  last_ = now;
  const Eigen::Vector3d moved = now.position_m - first_->position_m;
  const bool is_long = std::max(moved.norm(), integrated_m_[0].norm()) >= kPieceM;
  if (is_long && now.stamp_sec - first_->stamp_sec >= kShortestPieceSec) closePiece(moved);
}

void TwistCheck::startAt(const Sample& now) {
  first_ = last_ = now;
  integrated_m_.fill(Eigen::Vector3d::Zero());
}

void TwistCheck::closePiece(const Eigen::Vector3d& moved_m) {
  const double sec = last_->stamp_sec - first_->stamp_sec;
  const double changed_mps = (last_->velocity_mps[0] - first_->velocity_mps[0]).norm();
  Piece piece;
  piece.way_m = std::max(moved_m.norm(), integrated_m_[0].norm());
  piece.variance = 2.0 * square(kJitterM) + square(kVelocityDriftMPerSqrtSec) * sec +
                   square(kScale * piece.way_m) + square(kLateSec * changed_mps);
  piece.sec = sec;
  piece.turn_rad = Eigen::AngleAxisd(first_->R_odom_base).angle();
  for (int k = 0; k < kMeanings; ++k)
    piece.error_base_m[k] = first_->R_odom_base.transpose() * (integrated_m_[k] - moved_m);
  pieces_.push_back(piece);
  if (pieces_.size() > kMaxPieces) pieces_.pop_front();
  startAt(*last_);
  judge();
}

// Compares the error rates of successive pieces, because a steady bias cancels in the difference.
double TwistCheck::driftMPerSqrtSec() const {
  double squares = kFirstDriftAxes * square(kFirstDriftMPerSqrtSec), axes = kFirstDriftAxes;
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    const Piece &a = pieces_[i - 1], &b = pieces_[i];
    const Eigen::Vector2d apart_mps = (b.error_base_m[0] / b.sec - a.error_base_m[0] / a.sec).head<2>();
    const double jitter = 2.0 * square(kJitterM) * (1.0 / square(a.sec) + 1.0 / square(b.sec));
    squares += (apart_mps.squaredNorm() - 2.0 * jitter) / (1.0 / a.sec + 1.0 / b.sec);
    axes += 2.0;
  }
  return std::sqrt(std::max(0.0, squares / axes));
}

double TwistCheck::Sums::misfit() const { return std::sqrt(misfits[0] / squares); }

// A constant error of the velocity, fixed in the body, is no fault of its frame.
Eigen::Vector3d TwistCheck::biasMps(int meaning) const {
  std::vector<Eigen::Vector3d> errors_mps;
  for (const Piece& piece : pieces_) errors_mps.push_back(piece.error_base_m[meaning] / piece.sec);
  return geometry::componentwiseMedian(errors_mps);
}

TwistCheck::Sums TwistCheck::sums(double bias_sigma_mps) const {
  Sums sums;
  double known = 0.0;  // of the bias, against its prior
  for (const Piece& piece : pieces_) known += square(bias_sigma_mps * piece.sec) / piece.variance;
  Way bias_mps;
  for (int k = 0; k < kMeanings; ++k) {
    bias_mps[k] = biasMps(k);
    const double norm = bias_mps[k].norm();
    if (k == 0) sums.bias_mps = norm;
    bias_mps[k] *= known / (1.0 + known) * std::min(1.0, kMaxBiasMps / norm);
    sums.misfits[k] = bias_mps[k].squaredNorm() / square(bias_sigma_mps);
  }
  for (const Piece& piece : pieces_) {
    sums.way_m += piece.way_m;
    sums.squares += square(piece.way_m) / piece.variance;
    for (int k = 0; k < kMeanings; ++k) {
      const double error_m = (piece.error_base_m[k] - piece.sec * bias_mps[k]).norm();
      const double squares = square(error_m) / piece.variance;
      sums.misfits[k] += std::min(squares, kMaxSquares);
      if (k == 0) sums.own_squares += std::min(squares, kMaxOwnSquares);
    }
    sums.error_mps += square(piece.error_base_m[0].norm() / piece.sec) / static_cast<double>(pieces_.size());
    sums.turn_rad += square(piece.turn_rad) / static_cast<double>(pieces_.size());
  }
  sums.error_mps = std::sqrt(sums.error_mps), sums.turn_rad = std::sqrt(sums.turn_rad);
  return sums;
}

// Index of a far better meaning; zero if there is none.
std::size_t TwistCheck::betterMeaning(const Sums& sums, double max_misfit, double min_evidence) const {
  const auto least = std::min_element(sums.misfits.begin(), sums.misfits.end());
  const double numbers = 3.0 * static_cast<double>(pieces_.size()), floor = kLeastMeanSquares * numbers;
  const double evidence = 0.5 * numbers * std::log((sums.misfits[0] + floor) / (*least + floor));
  const bool is_good = *least < square(max_misfit) * sums.squares;
  const bool is_better = is_good && *least < kOtherMeaningBetter * sums.misfits[0] && evidence > min_evidence;
  return is_better ? static_cast<std::size_t>(least - sums.misfits.begin()) : 0;
}

std::size_t TwistCheck::betterMeaning(const Sums& all) const {
  const std::size_t exact = betterMeaning(sums(kNoBiasMps), kMaxExactMisfit, kMinExactEvidence);
  const std::size_t better = exact > 0 ? exact : betterMeaning(all, kMaxOtherMisfit, kMinEvidence);
  const bool is_vague = all.turn_rad < kSmallTurnRad && all.error_mps < kLeastTurnedErrorMps;
  return better <= kLastTurned && is_vague ? 0 : better;
}

void TwistCheck::judge() {
  const Sums all = sums(kBiasSigmaMps);
  if (all.way_m < kMinWayM) return;
  const bool is_enough = pieces_.size() >= kMinPieces, is_biased = is_enough && all.bias_mps > kMaxBiasMps;
  if (!is_biased && all.misfit() <= kMaxVelocityMisfit) {
    verdict_ = {FramesVerdict::kGood, ""};
    return;
  }
  const std::size_t better = betterMeaning(all);
  const double mean_squares = all.own_squares / (3.0 * static_cast<double>(pieces_.size()));
  const bool is_refuted = all.misfits[0] <= all.misfits[accused_];
  if (better > 0) {
    verdict_ = {FramesVerdict::kWrong, kNames[better]};
    accused_ = better;
  } else if (is_biased || (is_enough && mean_squares > kMaxMeanSquares)) {
    verdict_ = {FramesVerdict::kWrong,
                formatted("twist does not fit the path flown: off by %.0f %% and by a constant %.2f m/s",
                          100.0 * all.misfit(), all.bias_mps)};
    accused_ = 0;
  } else if (verdict_.state == FramesVerdict::kWrong && is_refuted) {
    verdict_ = {FramesVerdict::kUndecided, "velocity: the suspected fault in its axes was not confirmed"};
  }
}

}  // namespace window_ingress::estimation
