/// The target among windows of the same look.
#include <gtest/gtest.h>

#include "window_ingress/estimation/target_estimator.hpp"
#include "window_row.hpp"

namespace window_ingress::estimation::target_among_windows_test {

/// A vehicle that stands in front of a row of windows and sways a little, with a detector that tracks one of
/// them.
struct Watch {
  test::WindowRow row;
  TargetEstimator estimator{estimation::PoseParams(), estimation::FilterParams(), TargetEstimatorParams()};
  std::mt19937 random{3};
  double now_sec = 10.0;
  Eigen::Isometry3d T_base_camera =
      geometry::makePose(geometry::R_optical_flu().transpose(), Eigen::Vector3d::Zero());

  Watch() { row.noise_px = 0.05; }

  void look(int images, int target) {
    for (int n = 0; n < images; ++n, now_sec += 0.05) {
      const Eigen::Vector3d position(-6.0, -3.8 + 0.6 * std::sin(2.0 * now_sec), 1.5);
      estimator.addOdometry(now_sec, geometry::makePose(Eigen::Matrix3d::Identity(), position));
      const auto view = row.from(position);
      const auto look = row.look(now_sec, view, target, random);
      auto window = row.observation(target, now_sec, view, random);
      for (auto& covariance : window.corner_covariance) covariance = 0.01 * Eigen::Matrix2d::Identity();
      for (auto& edge : window.edges) edge = {true, 0.1, 0.001};
      window.score = 1.0;
      estimator.addDetection({now_sec, view.camera, T_base_camera, window, look.windows});
      estimator.flush();
    }
  }
  double y() const { return estimator.target(now_sec)->T_odom_window.translation().y(); }
};

TEST(TargetAmongWindows, IsNotExchangedForANeighbourThatTheDetectorFollowsAfterALoss) {
  Watch watch;
  watch.look(60, 2);
  ASSERT_TRUE(watch.estimator.target(watch.now_sec));
  EXPECT_NEAR(watch.y(), -3.8, 0.05);
  EXPECT_NE(watch.estimator.target(watch.now_sec)->window_id, 0u);
  watch.now_sec += 5.0;
  watch.look(60, 1);
  EXPECT_NE(watch.estimator.lastUpdate().why_not.find("which is the target"), std::string::npos);
  EXPECT_NEAR(watch.y(), -3.8, 0.05);
  watch.look(20, 2);
  EXPECT_NEAR(watch.y(), -3.8, 0.05);
}

TEST(TargetAmongWindows, FollowsTheOneThatIsChosenFromThenOn) {
  Watch watch;
  watch.look(60, 2);
  ASSERT_TRUE(watch.estimator.selectWindowNear(watch.row.centre(3)).success);
  EXPECT_FALSE(watch.estimator.target(watch.now_sec)) << "nothing of the one before is left";
  watch.look(5, 2);
  EXPECT_FALSE(watch.estimator.target(watch.now_sec));
  watch.look(60, 3);
  ASSERT_TRUE(watch.estimator.target(watch.now_sec));
  EXPECT_NEAR(watch.y(), watch.row.centre(3).y(), 0.05);
}

TEST(TargetAmongWindows, TheOneInUseIsGivenUpAndTheNextTakenWhereThatIsAllowed) {
  for (const bool next_one : {false, true}) {
    Watch watch;
    watch.look(60, 2);
    const std::uint32_t id = watch.estimator.target(watch.now_sec)->window_id;
    watch.estimator.addNavigatorState(id, {}, next_one);
    EXPECT_EQ(watch.estimator.facade().targetId(), id);
    for (int n = 0; n < 3; ++n) watch.estimator.addNavigatorState(0, {id}, next_one);  // repeated messages
    EXPECT_EQ(watch.estimator.facade().targetId() != 0, next_one);
    EXPECT_NE(watch.estimator.facade().targetId(), id);
    EXPECT_EQ(watch.estimator.target(watch.now_sec).has_value(), !next_one);
  }
}

// The navigator goes on naming windows of the last mission, by numbers from before the reset.
TEST(TargetAmongWindows, AfterAResetOldNumbersSayNothingOfNewWindows) {
  Watch watch;
  watch.estimator.addNavigatorState(0, {}, false);
  watch.look(60, 2);
  const std::uint32_t id = watch.estimator.target(watch.now_sec)->window_id;
  watch.estimator.addNavigatorState(0, {id}, false);
  watch.estimator.reset();
  watch.look(60, 2);
  watch.estimator.addNavigatorState(0, {id}, false);
  ASSERT_TRUE(watch.estimator.target(watch.now_sec));
  EXPECT_EQ(watch.estimator.target(watch.now_sec)->window_id, id) << "numbered anew";
}

}  // namespace window_ingress::estimation::target_among_windows_test
