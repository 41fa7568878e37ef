#include "estimation/checks/flight_checks.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::estimation {
namespace {

constexpr int kEnough = 10;
constexpr double kMaxGapRad = 0.35;  // between "up" of imu and of odometry

}  // namespace

bool AttitudeCheck::see(const Eigen::Matrix3d& R_odom_base_imu, const Eigen::Matrix3d& R_odom_base_odometry) {
  const Eigen::RowVector3d up_imu = R_odom_base_imu.row(2), up_odometry = R_odom_base_odometry.row(2);
  const double apart_rad = std::acos(std::clamp(up_imu.dot(up_odometry), -1.0, 1.0));
  const bool agree = apart_rad <= kMaxGapRad;
  in_a_row_ =
      agree ? std::min(std::max(in_a_row_, 0) + 1, kEnough) : std::max(std::min(in_a_row_, 0) - 1, -kEnough);
  if (in_a_row_ == kEnough) verdict_ = {FramesVerdict::kGood, ""};
  if (in_a_row_ > -kEnough) return agree;
  verdict_ = {FramesVerdict::kWrong,
              formatted("attitudes of imu and odometry differ by %.0f deg: different axes?",
                        apart_rad * geometry::kDegreesPerRad)};
  return false;
}

FramesVerdict FlightChecks::frames() const {
  const FramesVerdict mounted = mounting.verdict(), twisted = twist.verdict(), tilted = attitude.verdict();
  const auto are = [&](FramesVerdict::State state) {
    return (mounted.state == state) + (twisted.state == state);
  };
  const bool wrong = are(FramesVerdict::kWrong) > 0 || tilted.state == FramesVerdict::kWrong;
  FramesVerdict out;
  out.state = wrong                            ? FramesVerdict::kWrong
              : are(FramesVerdict::kGood) == 2 ? FramesVerdict::kGood
                                               : FramesVerdict::kUndecided;
  for (const FramesVerdict& part :
       wrong ? std::vector{mounted, tilted, twisted} : std::vector{mounted, twisted})
    if (part.state == out.state) out.what += (out.what.empty() ? "" : "; ") + part.what;
  return out;
}

void FlightChecks::clear() {
  mounting.clear();
  parallax.clear();
  twist.clear();
  attitude.clear();
}

void FlightChecks::forgetPlaces() {
  mounting.forgetPlaces();
  parallax.clear();
  twist.startPiece();
}

}  // namespace window_ingress::estimation
