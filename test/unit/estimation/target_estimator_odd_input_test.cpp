#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>
#include <random>

#include "window_ingress/estimation/target_estimator.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation::target_estimator_odd_input_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

const geometry::PinholeCamera kCamera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);
const Eigen::Isometry3d kMounting =
    geometry::makePose(geometry::R_optical_flu().transpose(), {0.1, 0.0, 0.02});
const Eigen::Isometry3d kWindow = geometry::makePose(geometry::yawRotation(0.2), {5.0, 0.3, 1.4});

/// Draws numbers that no sensor should send, and puts them into inputs.
class Mischief {
 public:
  explicit Mischief(unsigned seed) : random_(seed) {}

  bool happens(double probability) { return std::bernoulli_distribution(probability)(random_); }
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  double odd() {
    const double numbers[] = {kNan, kInf, -kInf, 0.0, -1.0, 1e300, -1e300, 1e-300, 1e9, -1e9, 3.7};
    return numbers[pick(11)];
  }
  void spoil(detection::WindowObservation& window) {
    const int i = pick(4);
    switch (pick(11)) {
      case 0:
        window.corners[i](pick(2)) = odd();
        break;
      case 1:
        window.corner_covariance[i].setConstant(odd());
        break;
      case 2:
        window.edges[i].sigma_px = odd();
        break;
      case 3:
        window.edges[i].sigma_rad = odd();
        break;
      case 4:
        window.edges[i].a(pick(2)) = odd();
        break;
      case 5:
        window.edges[i].visible = false;
        break;
      case 6:
        window.corner_visible[i] = false;
        break;
      case 7:
        window.stamp_sec = odd();
        break;
      case 8:
        std::swap(window.corners[i], window.corners[(i + 1) % 4]);
        break;
      case 9:
        window.corners[i] = window.corners[(i + 1) % 4];
        break;
      default:
        window.target_id = static_cast<std::uint32_t>(pick(3));
        break;
    }
  }
  void spoil(Eigen::Isometry3d& pose) { pose.matrix()(pick(3), pick(4)) = odd(); }

 private:
  std::mt19937 random_;
};

detection::WindowObservation sighting(const Eigen::Isometry3d& T_odom_base, double stamp_sec) {
  detection::WindowObservation window;
  const Eigen::Isometry3d T_camera_window = (T_odom_base * kMounting).inverse() * kWindow;
  window.corners = *geometry::projectOpening(kCamera, T_camera_window, {1.2, 1.0});
  for (int i = 0; i < 4; ++i) {
    window.corner_covariance[i] = 0.01 * Eigen::Matrix2d::Identity();
    window.edges[i] = {true, 0.1, 0.001, window.corners[i], window.corners[(i + 1) % 4]};
  }
  window.stamp_sec = stamp_sec;
  window.target_id = 1;
  return window;
}

bool isSound(const Eigen::MatrixXd& covariance) {
  if (!covariance.allFinite()) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  return eigen.eigenvalues().minCoeff() > -1e-9 * eigen.eigenvalues().maxCoeff() &&
         (covariance - covariance.transpose()).norm() <= 1e-6 * covariance.norm();
}

void expectSound(const TargetEstimator& estimator, double now_sec, unsigned seed) {
  if (const auto window = estimator.filtered(now_sec)) {
    EXPECT_TRUE(geometry::isValidPose(window->T_odom_window)) << seed;
    EXPECT_TRUE(isSound(window->covariance)) << seed << '\n' << window->covariance;
    EXPECT_TRUE(isSound(window->size.log_covariance)) << seed << '\n' << window->size.log_covariance;
    EXPECT_GT(window->size.size.width_m * window->size.size.height_m, 0.0) << seed;
    EXPECT_TRUE(std::isfinite(window->consistency.mean_nis)) << seed;
  }
  const auto& result = estimator.lastUpdate().pose;
  if (!result.estimate) return;
  EXPECT_TRUE(geometry::isValidPose(result.estimate->best.T_camera_window)) << seed;
  EXPECT_TRUE(isSound(result.estimate->best.covariance)) << seed << '\n' << result.estimate->best.covariance;
  EXPECT_TRUE(std::isfinite(result.estimate->yaw_rad + result.estimate->yaw_sigma_rad +
                            result.estimate->sigma_u_rad + result.estimate->opening_width_m +
                            result.estimate->log_likelihood_ratio))
      << seed;
}

estimation::PoseParams paramsOf(unsigned seed) {
  estimation::PoseParams params;
  if (seed % 3 > 0) params.scale_sigma = 0.5;
  if (seed % 3 > 1) params.aspect_sigma = 0.3;
  return params;
}

TEST(TargetEstimatorOddInput, WhateverComesWhatLeavesIsSoundAndTheWindowIsFoundAgain) {
  int wrong = 0;
  for (unsigned seed = 1; seed <= 120; ++seed) {
    Mischief mischief(seed);
    TargetEstimator estimator(paramsOf(seed), estimation::FilterParams(), TargetEstimatorParams());
    double now = 0.0;
    for (int i = 0; i < 240; ++i, now += 0.033) {
      const bool calm = i >= 150;  // from here on all inputs are valid
      const auto odd = [&](double probability) { return !calm && mischief.happens(probability); };
      const double y = 0.4 * std::sin(now);
      const Eigen::Isometry3d truth = geometry::makePose(geometry::yawRotation(0.05), {0.2 * now, y, 1.2});
      Eigen::Isometry3d odometry = truth, mounting = kMounting;
      Eigen::Vector3d velocity(0.2, 0.4 * std::cos(now), 0.0);
      double stamp = now;
      if (odd(0.03)) mischief.spoil(odometry);
      if (odd(0.03)) velocity(mischief.pick(3)) = mischief.odd();
      if (odd(0.02)) stamp = mischief.odd();
      if (odd(0.02)) stamp = now - 0.05;
      if (odd(0.02)) mischief.spoil(mounting);
      estimator.addOdometry(stamp, odometry, velocity);
      Eigen::Quaterniond attitude(truth.linear());
      if (odd(0.03)) attitude.coeffs()(mischief.pick(4)) = mischief.odd();
      estimator.addAttitude(odd(0.02) ? mischief.odd() : now, attitude);
      auto window = sighting(truth, now);
      if (odd(0.2)) mischief.spoil(window);
      if (odd(0.05)) mischief.spoil(window);
      geometry::PinholeCamera camera = kCamera;
      if (odd(0.02)) camera.fx = mischief.odd();
      estimator.addDetection(window, camera, odd(0.02) ? std::nullopt : std::make_optional(mounting));
      expectSound(estimator, now, seed);
      if (::testing::Test::HasFailure()) return;
    }
    const auto target = estimator.target(now);
    ASSERT_TRUE(target) << seed << ' ' << estimator.lastUpdate().why_not;
    EXPECT_LT((target->T_odom_window.translation() - kWindow.translation()).norm(), 0.5) << seed;
    wrong += estimator.frames().state == estimation::FramesVerdict::kWrong;
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_LE(wrong, 2) << "numbers that are wrong but finite may look like wrong frames for a while";
}

}  // namespace window_ingress::estimation::target_estimator_odd_input_test
