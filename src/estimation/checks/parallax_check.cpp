#include "estimation/checks/parallax_check.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::estimation {
namespace {

constexpr double kSpacingM = 0.02;
constexpr double kLongestSec = 4.0;  // odometry drifts over longer times
constexpr std::size_t kMin = 5;
constexpr double kPlaceSigmaM = 0.015, kBearingSigmaRad = 0.005;  // of one image: odometry, attitude
constexpr double kSpanFactor = 1.5;  // noise of a line through both ends of a path, which others help little
constexpr double kSigmas = 2.5;
constexpr double kLateM = 0.15;  // motion and turn of the line of sight if odometry is 0.1 s late
constexpr double kTurnRadPerSqrtSec = 0.003;
constexpr double kOtherSlope = 0.35, kSameSlope = 0.5;

}  // namespace

bool ParallaxCheck::isNew(double stamp_sec, const Eigen::Vector3d& camera_odom_m) const {
  return sights_.empty() || (stamp_sec > sights_.back().stamp_sec &&
                             (camera_odom_m - sights_.back().camera).norm() >= kSpacingM);
}

void ParallaxCheck::see(double stamp_sec, const Eigen::Vector3d& camera_odom_m,
                        const Eigen::Vector3d& window_odom_m) {
  if (!std::isfinite(stamp_sec) || !camera_odom_m.allFinite() || !window_odom_m.allFinite()) return;
  if (!isNew(stamp_sec, camera_odom_m)) return;
  sights_.push_back({stamp_sec, camera_odom_m, window_odom_m});
  while (stamp_sec - sights_.front().stamp_sec > kLongestSec) sights_.pop_front();
  if (sights_.size() >= kMin) judge();
}

// Slope of the window's computed motion over the camera's, both across the line of sight: 1 - 1/k.
void ParallaxCheck::judge() {
  Eigen::Vector3d camera_mean = Eigen::Vector3d::Zero(), window_mean = Eigen::Vector3d::Zero();
  for (const Sight& sight : sights_) {
    camera_mean += sight.camera / static_cast<double>(sights_.size());
    window_mean += sight.window / static_cast<double>(sights_.size());
  }
  const Eigen::Vector3d sight_line = window_mean - camera_mean;
  const double distance_m = sight_line.norm();
  if (!(distance_m > 0.0)) return;
  const Eigen::Matrix3d across =
      Eigen::Matrix3d::Identity() - sight_line * sight_line.transpose() / (distance_m * distance_m);
  double both = 0.0, squares = 0.0, span_m = 0.0;
  for (const Sight& sight : sights_) {
    const Eigen::Vector3d way = across * (sight.camera - camera_mean);
    both += way.dot(sight.window - window_mean);
    squares += way.squaredNorm();
    span_m = std::max(span_m, (across * (sight.camera - sights_.front().camera)).norm());
  }
  if (!(squares > 0.0 && span_m > 0.0)) return;
  const double slope = both / squares;
  const double elapsed_sec = sights_.back().stamp_sec - sights_.front().stamp_sec;
  const double noise_m = std::hypot(kPlaceSigmaM, kBearingSigmaRad * distance_m);
  const double drift_m =
      std::hypot(drift_m_per_sqrt_sec_, kTurnRadPerSqrtSec * distance_m) * std::sqrt(elapsed_sec);
  const double moved_m = kSigmas * target_speed_mps_ * elapsed_sec;
  const double spread = (kLateM + moved_m + kSigmas * std::hypot(kSpanFactor * noise_m, drift_m)) / span_m;
  if (std::abs(slope) - spread > kOtherSlope) other_factor_ = 1.0 / std::max(0.01, 1.0 - slope);
  if (std::abs(slope) + spread < kSameSlope) other_factor_.reset();
}

}  // namespace window_ingress::estimation
