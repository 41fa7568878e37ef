/// Statistics of the single-image estimator, compared with its stated covariance and with the Cramér-Rao
/// bound.
#include <gtest/gtest.h>

#include <cstdio>

#include "pose_fixtures.hpp"

namespace window_ingress::estimation::monte_carlo_test {

using namespace fixtures;

// The bounds were published for f = 554 px and an opening of 1 m by 1 m.
const geometry::PinholeCamera kCamera =
    geometry::PinholeCamera::fromFieldOfView(640, 480, 2.0 * std::atan(320.0 / 554.0));
constexpr geometry::OpeningSize kSquare{1.0, 1.0};

struct Cell {
  double distance_m, yaw_deg, corner_bound_deg;
};

struct Spread {
  double rmse_deg = 0, claimed_deg = 0, squares = 0;
  int flips = 0, count = 0;
};

template <typename See>
Spread run(const Cell& cell, int draws, See&& see) {
  PoseParams params = trustingParams();
  params.opening_width_m = params.opening_height_m = 1.0;
  const WindowPoseEstimator estimator{params};
  const double truth = cell.yaw_deg * kDegree;
  Spread spread;
  for (int i = 0; i < draws; ++i) {
    const auto result = estimator.estimate(see(view(cell.distance_m, truth)), kCamera);
    if (!result.estimate) continue;
    auto yaw = *result.estimate;
    if (yaw.yaw_rad * truth < 0.0) ++spread.flips;
    const double error = yaw.yaw_rad * truth < 0.0 ? -yaw.yaw_rad - truth : yaw.yaw_rad - truth;
    spread.rmse_deg += error * error / (kDegree * kDegree);
    spread.claimed_deg += yaw.yaw_sigma_rad * yaw.yaw_sigma_rad / (kDegree * kDegree);
    spread.squares += error * error / (yaw.yaw_sigma_rad * yaw.yaw_sigma_rad);
    ++spread.count;
  }
  spread.rmse_deg = std::sqrt(spread.rmse_deg / spread.count);
  spread.claimed_deg = std::sqrt(spread.claimed_deg / spread.count);
  spread.squares /= spread.count;
  return spread;
}

TEST(MonteCarlo, CornersReachTheBound) {
  std::mt19937 random(5);
  // Bounds for 1 px. At a third of 1 px the two solutions are separate and the errors linear.
  for (const Cell cell : {Cell{2, 0, 0.83}, Cell{2, 10, 0.73}, Cell{2, 30, 0.43}, Cell{4, 10, 2.3},
                          Cell{4, 30, 1.0}, Cell{6, 30, 1.6}, Cell{8, 30, 2.1}}) {
    const double sigma = 0.1;
    const auto spread = run(cell, 2000, [&](const Eigen::Isometry3d& T) {
      auto window = cornersSeen(kCamera, T, sigma, kSquare);
      disturb(window, sigma, random);
      return window;
    });
    std::printf("corners %.1f px, %g m, %2.0f deg: rmse %.4f, claimed %.4f, bound %.4f deg, flips %d\n",
                sigma, cell.distance_m, cell.yaw_deg, spread.rmse_deg, spread.claimed_deg,
                sigma * cell.corner_bound_deg, spread.flips);
    EXPECT_EQ(spread.count, 2000);
    EXPECT_NEAR(spread.rmse_deg / (sigma * cell.corner_bound_deg), 1.0, 0.1);
    EXPECT_NEAR(spread.rmse_deg / spread.claimed_deg, 1.0, 0.1);
    EXPECT_NEAR(spread.squares, 1.0, 0.15);
  }
}

TEST(MonteCarlo, OnePixelCorners) {
  std::mt19937 random(6);
  for (const Cell cell : {Cell{2, 0, 0.83}, Cell{2, 10, 0.73}, Cell{2, 30, 0.43}, Cell{4, 10, 2.3},
                          Cell{4, 30, 1.0}, Cell{6, 10, 4.1}, Cell{6, 30, 1.6}, Cell{8, 30, 2.1}}) {
    const auto spread = run(cell, 2000, [&](const Eigen::Isometry3d& T) {
      auto window = cornersSeen(kCamera, T, 1.0, kSquare);
      disturb(window, 1.0, random);
      return window;
    });
    std::printf(
        "corners 1.0 px, %g m, %2.0f deg: rmse %.3f (branch apart), claimed %.3f, bound %.3f deg, flips %.2f "
        "%%\n",
        cell.distance_m, cell.yaw_deg, spread.rmse_deg, spread.claimed_deg, cell.corner_bound_deg,
        100.0 * spread.flips / spread.count);
    EXPECT_GT(spread.count, 1950);
    EXPECT_LT(spread.rmse_deg, 1.3 * cell.corner_bound_deg);
    EXPECT_GT(spread.rmse_deg, 0.75 * cell.corner_bound_deg);
  }
}

TEST(MonteCarlo, BordersBeatCorners) {
  std::mt19937 random(8);
  const double bounds[][4] = {{2, 10, 0.09}, {2, 30, 0.04}, {4, 10, 0.35},
                              {4, 30, 0.13}, {6, 30, 0.25}, {8, 30, 0.38}};
  for (const auto& row : bounds) {
    const Cell cell{row[0], row[1], row[2]};
    const auto spread = run(cell, 2000, [&](const Eigen::Isometry3d& T) {
      return bordersSeen(kCamera, T, 1.0, random, kSquare);
    });
    std::printf("borders 1 px a sample, %g m, %2.0f deg: rmse %.3f, claimed %.3f, published bound %.3f deg\n",
                cell.distance_m, cell.yaw_deg, spread.rmse_deg, spread.claimed_deg, row[2]);
    EXPECT_NEAR(spread.rmse_deg / spread.claimed_deg, 1.0, 0.1);
    EXPECT_NEAR(spread.squares, 1.0, 0.15);
    EXPECT_LT(spread.rmse_deg, 2.0 * row[2]);
  }
}

TEST(MonteCarlo, TrustedSignsAreRight) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> distance(1.5, 8.0), sigma(0.1, 1.0);
  for (const double widest_deg : {60.0, 15.0}) {
    std::uniform_real_distribution<double> angle(-widest_deg, widest_deg);
    const WindowPoseEstimator estimator{trustingParams()};
    int trusted = 0, wrong = 0, flips = 0;
    for (int i = 0; i < 15000; ++i) {
      const double truth = angle(random) * kDegree, noise = sigma(random);
      auto window = cornersSeen(camera(), view(distance(random), truth), noise);
      disturb(window, noise, random);
      const auto result = estimator.estimate(window, camera());
      if (!result.estimate) continue;
      const bool flip = result.estimate->yaw_rad * truth < 0.0;
      flips += flip;
      trusted += result.estimate->sign_trusted;
      wrong += result.estimate->sign_trusted && flip;
    }
    std::printf("yaw up to %g deg: trusted %d of 15000, wrong %d (%.3f %%); wrong of all %.2f %%\n",
                widest_deg, trusted, wrong, 100.0 * wrong / trusted, 100.0 * flips / 15000);
    EXPECT_GT(trusted, 5000);
    EXPECT_LE(wrong, 0.002 * trusted);
  }
}

}  // namespace window_ingress::estimation::monte_carlo_test
