#include "evaluation/flights/projected_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "evaluation/flights/closed_loop_flight.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::evaluation::projected_detector_test {

const auto kCamera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);
const geometry::OpeningSize kOpening{1.2, 1.0};

/// Observation from this place in the window's frame, with a heading along its axis plus a turn to the left.
Eigen::Isometry3d T_camera_window(const Eigen::Vector3d& position_m, double turn_rad = 0.0) {
  const Eigen::Isometry3d T_window_camera =
      geometry::makePose(geometry::yawRotation(turn_rad) * geometry::R_optical_flu().transpose(), position_m);
  return T_window_camera.inverse();
}

std::optional<detection::WindowObservation> seenFrom(const Eigen::Vector3d& position_m,
                                                     double turn_rad = 0.0) {
  ProjectedDetector sight(1);
  sight.look(kCamera, T_camera_window({-4.0, 0.0, 0.0}), kOpening, 0.9);  // whole, for a first time
  return sight.look(kCamera, T_camera_window(position_m, turn_rad), kOpening, 1.0);
}

TEST(ProjectedDetector, CornersAreTheTrueOnesWithTheSpreadTheyState) {
  const auto pose = T_camera_window({-4.0, 0.8, 0.2}, -0.2);
  const auto truth = *geometry::projectOpening(kCamera, pose, kOpening);
  SightParams params;
  params.lasting_sigma_px = 0.0;
  ProjectedDetector sight(3, params);
  double squares = 0.0;
  constexpr int kViews = 2000;
  for (int i = 0; i < kViews; ++i) {
    const auto window = sight.look(kCamera, pose, kOpening, 0.03 * i);
    ASSERT_TRUE(window && window->whole());
    const Eigen::Vector2d error = window->corners[2] - truth[2];
    squares += error.dot(window->corner_covariance[2].inverse() * error) / (2.0 * kViews);
  }
  EXPECT_NEAR(squares, 1.0, 0.1);
}

TEST(ProjectedDetector, NearTheWindowSidesLeaveTheImage) {
  EXPECT_EQ(seenFrom({-4.0, 0.0, 0.0})->visibleSides(), 4);
  const auto near = seenFrom({-0.92, 0.0, 0.0});  // higher than the image, not wider yet
  ASSERT_TRUE(near);
  EXPECT_EQ(near->visibleSides(), 2);
  EXPECT_FALSE(near->whole());
  EXPECT_FALSE(near->edges[0].visible);
  EXPECT_TRUE(near->edges[1].visible);
  EXPECT_FALSE(seenFrom({-0.3, 0.0, 0.0})) << "the image lies within the window";
}

TEST(ProjectedDetector, NothingFromBehindBesideOrTooFar) {
  EXPECT_FALSE(seenFrom({1.0, 0.0, 0.0}, M_PI));
  EXPECT_FALSE(seenFrom({-4.0, 0.0, 0.0}, M_PI));
  EXPECT_FALSE(seenFrom({-4.0, 0.0, 0.0}, 1.2));
  EXPECT_FALSE(seenFrom({-60.0, 0.0, 0.0}));
}

TEST(ProjectedDetector, APartIsNoWindowBeforeTheWholeWasSeen) {
  ProjectedDetector sight(1);
  EXPECT_FALSE(sight.look(kCamera, T_camera_window({-0.92, 0.0, 0.0}), kOpening, 0.0));
}

TEST(ProjectedDetector, MissesAsOftenAsItIsToldTo) {
  SightParams params;
  params.miss_rate = 0.3;
  ProjectedDetector sight(5, params);
  int missed = 0;
  for (int i = 0; i < 2000; ++i)
    missed += !sight.look(kCamera, T_camera_window({-4.0, 0.0, 0.0}), kOpening, 0.03 * i);
  EXPECT_NEAR(missed / 2000.0, 0.3, 0.04);
}

TEST(ProjectedDetector, AFlightWithoutImagesPassesAndRepeats) {
  simulation::Scenario scenario;
  scenario.start.distance_m = 3.5;
  scenario.start.off_axis_rad = 0.3;
  FlightParams params;
  params.without_images = true;
  const auto one = flyOnce(scenario, 7, params), again = flyOnce(scenario, 7, params);
  EXPECT_EQ(one.outcome, simulation::Outcome::kPassed) << one.reason;
  EXPECT_EQ(one.time_sec, again.time_sec);
  EXPECT_EQ(one.offset_y_m, again.offset_y_m);
  scenario.window.present = false;
  EXPECT_NE(flyOnce(scenario, 7, params).outcome, simulation::Outcome::kPassed);
}

}  // namespace window_ingress::evaluation::projected_detector_test
