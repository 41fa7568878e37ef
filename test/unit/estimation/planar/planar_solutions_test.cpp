#include "estimation/planar/planar_solutions.hpp"

#include <gtest/gtest.h>

#include "../pose_fixtures.hpp"

namespace window_ingress::estimation::planar_solutions_test {

using namespace fixtures;

struct Solved {
  geometry::PinholeCamera camera = fixtures::camera();
  std::optional<PlanarSolutions> solutions;
};

Solved solve(const detection::WindowObservation& window, const std::optional<GravityPrior>& gravity = {}) {
  Solved solved;
  const auto image = ImageMeasurement::make(window, solved.camera, {0.001, 1.0, 1.0, 1e12}).value();
  solved.solutions = planarSolutions({image, solved.camera, kOpening, gravity});
  return solved;
}

TEST(PlanarSolutions, MirroringTwiceIsNothing) {
  const auto T = view(5.0, 0.4, 1.0, 0.5);
  EXPECT_TRUE(mirrored(mirrored(T)).isApprox(T, 1e-12));
  EXPECT_NEAR(mirrored(T).linear().determinant(), 1.0, 1e-12);
  EXPECT_TRUE(geometry::isValidPose(mirrored(T)));
  EXPECT_TRUE(mirrored(view(5.0, 0.4)).isApprox(view(5.0, -0.4), 1e-12));
}

TEST(PlanarSolutions, FarAwayBothAreKeptAndTheTruthIsOneOfThem) {
  std::mt19937 random(1);
  int wrong_first = 0, both = 0;
  for (int i = 0; i < 500; ++i) {
    const double yaw = i % 2 ? 0.35 : -0.35;
    auto window = cornersSeen(camera(), view(8.0, yaw), 1.0);
    disturb(window, 1.0, random);
    const auto solved = solve(window);
    ASSERT_TRUE(solved.solutions);
    const auto yawOf = [](const PlanarSolution& s) {
      return geometry::yawOf(geometry::R_optical_flu().transpose() * s.T_camera_window.linear());
    };
    wrong_first += yawOf(solved.solutions->best) * yaw < 0;
    if (!solved.solutions->alternative) continue;
    ++both;
    EXPECT_LE(solved.solutions->best.cost, solved.solutions->alternative->cost);
  }
  EXPECT_GT(wrong_first, 10) << "one image cannot tell at this distance";
  EXPECT_GT(both, 350);
}

TEST(PlanarSolutions, TheBestIsTheGlobalMinimum) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> distance(2.0, 8.0), angle(-1.0, 1.0), tilt(-0.3, 0.3);
  int beaten = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto T = view(distance(random), angle(random));
    auto window = cornersSeen(camera(), T, 0.5);
    disturb(window, 0.5, random);
    const auto image = ImageMeasurement::make(window, fixtures::camera(), {0.001, 1.0, 1.0, 1e12}).value();
    const auto lens = camera();
    const RefinementProblem problem{image, lens, kOpening, std::nullopt};
    const auto solutions = planarSolutions(problem);
    ASSERT_TRUE(solutions);
    auto start = T;
    for (int k = 0; k < 4; ++k) {
      const auto other = refine(problem, FitPoint{start, Eigen::Vector2d::Zero()});
      if (other && other->cost < solutions->best.cost - 1e-6) ++beaten;
      start.linear() = T.linear() * geometry::rotationFromEuler({0, tilt(random), angle(random)});
    }
  }
  EXPECT_EQ(beaten, 0);
}

TEST(PlanarSolutions, GravityRefinesButDoesNotChoose) {
  std::mt19937 random(3);
  int differs = 0;
  for (int i = 0; i < 500; ++i) {
    auto window = cornersSeen(camera(), view(4.0, 0.3), 0.3);
    disturb(window, 0.3, random);
    const auto without = solve(window), with = solve(window, GravityPrior{});
    ASSERT_TRUE(without.solutions && with.solutions);
    const Eigen::Matrix3d a = without.solutions->best.T_camera_window.linear(),
                          b = with.solutions->best.T_camera_window.linear();
    EXPECT_LE(std::abs(b(1, 0)), std::abs(a(1, 0)) + 0.01) << "more upright";
    differs += a(0, 0) * b(0, 0) < 0.0;
  }
  EXPECT_LE(differs, 2);
}

TEST(PlanarSolutions, NothingForWhatIsNoQuadrilateral) {
  auto window = cornersSeen(camera(), view(4.0, 0.3), 0.3);
  window.corners = {Eigen::Vector2d(10, 10), Eigen::Vector2d(20, 10), Eigen::Vector2d(30, 10),
                    Eigen::Vector2d(40, 10)};
  EXPECT_FALSE(solve(window).solutions);
}

}  // namespace window_ingress::estimation::planar_solutions_test
