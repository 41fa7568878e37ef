#include "window_ingress/openness/openness_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "evaluation/openness/openness_survey.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::openness::openness_judge_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using evaluation::Interior;

const geometry::OpeningSize kOpening{1.2, 1.0}, kNeeded{0.6, 0.34};
const auto kCamera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);

/// A straight approach, without noise, to points `depth_m` behind the border.
struct Approach {
  double depth_m = 3.0, sideways_m = 0.0;
  std::uint32_t target_id = 1;
  double moving = 0.0;  // fraction of points that swirl around the image's centre

  Isometry3d camera(double plane_m) const {
    return geometry::makePose(geometry::R_optical_flu().transpose(),
                              {-plane_m, sideways_m * (5.0 - plane_m), 0.05});
  }

  detection::WindowObservation look(double plane_m, double key_m) const {
    detection::WindowObservation window;
    window.stamp_sec = stamp(plane_m);
    window.target_id = target_id;
    window.corners = *geometry::projectOpening(kCamera, camera(plane_m).inverse(), kOpening);
    window.corner_covariance.fill(0.04 * Eigen::Matrix2d::Identity());
    auto& tracks = window.interior;
    tracks.key_stamp_sec = stamp(key_m);
    tracks.key_corners = *geometry::projectOpening(kCamera, camera(key_m).inverse(), kOpening);
    tracks.key_covariance = window.corner_covariance;
    tracks.sigma_px = 0.4;
    for (int i = 0; i < 49; ++i) {
      const Vector3d front(0.0, 0.15 * (i % 7 - 3), 0.13 * (i / 7 - 3));
      const Vector3d way = (front - camera(key_m).translation()) / key_m;
      const Vector3d point = front + depth_m * way;
      Eigen::Vector2d now = *kCamera.project(camera(plane_m).inverse() * point);
      const Eigen::Vector2d out = (now - Eigen::Vector2d(320, 240)).normalized();
      if (i < 49 * moving && plane_m < key_m) now += 40.0 * Eigen::Vector2d(-out.y(), out.x());
      tracks.points.push_back({static_cast<std::uint16_t>(i),
                               *kCamera.project(camera(key_m).inverse() * point), now,
                               Eigen::Vector2d::Zero(), 0});
    }
    return window;
  }

  void fly(OpennessJudge& judge, double from_m, double to_m) const {
    double key_m = from_m;
    for (double plane_m = from_m; plane_m > to_m; plane_m -= 0.05) {
      const auto window = look(plane_m, key_m);
      judge.see({window, kCamera, camera(plane_m), Isometry3d::Identity(), kOpening});
      if (plane_m < 0.75 * key_m) key_m = plane_m;
    }
  }

  static double stamp(double plane_m) { return 100.0 + 5.0 - plane_m; }
};

Openness verdictOf(const Approach& approach) {
  OpennessJudge judge({}, kNeeded);
  approach.fly(judge, 5.0, 1.6);
  return judge.verdict().openness;
}

TEST(OpennessJudge, tellsRoomsFromPanes) {
  for (const double depth_m : {1.0, 1.5, 3.0, 6.0})
    EXPECT_EQ(verdictOf({depth_m}), Openness::kOpen) << depth_m << " m";
  for (const double depth_m : {-0.02, 0.0, 0.07, 0.2, 0.3})
    EXPECT_EQ(verdictOf({depth_m}), Openness::kClosed) << depth_m << " m";
  EXPECT_EQ(verdictOf({3.0, 0.3}), Openness::kOpen) << "sideways, too";
  EXPECT_EQ(verdictOf({0.1, 0.3}), Openness::kClosed) << "sideways, too";
}

TEST(OpennessJudge, neitherCurtainNorRoomIsUnknown) { EXPECT_EQ(verdictOf({0.5}), Openness::kUnknown); }

TEST(OpennessJudge, deeperThanARoomIsNotOpen) { EXPECT_EQ(verdictOf({60.0}), Openness::kUnknown); }

TEST(OpennessJudge, recoversTheDepth) {
  for (const double depth_m : {0.1, 1.0, 2.0, 4.0}) {
    OpennessJudge judge({}, kNeeded);
    Approach{depth_m}.fly(judge, 5.0, 1.6);
    ASSERT_TRUE(judge.verdict().has_depth);
    EXPECT_NEAR(judge.verdict().depth_behind_m, depth_m, 1e-3 + 0.01 * depth_m);
    EXPECT_GT(judge.verdict().depth_sigma_m, 0.0);
  }
}

TEST(OpennessJudge, oneStretchIsNeverEnough) {
  OpennessJudge judge({}, kNeeded);
  Approach{3.0}.fly(judge, 4.0, 3.1);
  EXPECT_EQ(judge.verdict().openness, Openness::kUnknown);
  EXPECT_GT(judge.verdict().log_odds, 0.0);
  EXPECT_LE(judge.verdict().log_odds, kMaxLogOdds);
}

TEST(OpennessJudge, whatMovesIsOutvotedUnlessItIsMost) {
  const auto after = [](double still_m, double moving) {
    OpennessJudge judge({}, kNeeded);
    Approach{3.0}.fly(judge, 5.0, still_m);
    Approach{3.0, 0.0, 1, moving}.fly(judge, still_m, still_m - 0.5);
    return judge.verdict();
  };
  EXPECT_EQ(after(2.0, 0.0).openness, Openness::kOpen);
  EXPECT_EQ(after(2.0, 0.42).openness, Openness::kOpen) << "three stretches say open";
  EXPECT_EQ(after(2.0, 0.6).openness, Openness::kUnknown) << "most of it moves now";
  EXPECT_EQ(after(4.0, 0.42).openness, Openness::kUnknown) << "one stretch does not outvote it";
}

TEST(OpennessJudge, hoveringTellsNothing) {
  OpennessJudge judge({}, kNeeded);
  const Approach room{3.0};
  for (int i = 0; i < 300; ++i) {
    auto window = room.look(3.0, 3.0);
    window.stamp_sec = 100.0 + 0.03 * i;
    window.interior.key_stamp_sec = 100.0 + 2.0 * std::floor(0.015 * i);
    judge.see({window, kCamera, room.camera(3.0), Isometry3d::Identity(), kOpening});
  }
  EXPECT_EQ(judge.verdict().openness, Openness::kUnknown);
  EXPECT_EQ(judge.verdict().log_odds, 0.0);
}

TEST(OpennessJudge, anotherTargetResetAndTimeThatGoesBackForgetIt) {
  OpennessJudge judge({}, kNeeded);
  const Approach room{3.0};
  room.fly(judge, 5.0, 1.6);
  ASSERT_EQ(judge.verdict().openness, Openness::kOpen);
  auto window = room.look(1.6, 1.6);
  window.target_id = 2;
  judge.see({window, kCamera, room.camera(1.6), Isometry3d::Identity(), kOpening});
  EXPECT_EQ(judge.verdict().openness, Openness::kUnknown);
  EXPECT_EQ(judge.verdict().log_odds, 0.0);

  OpennessJudge another({}, kNeeded);
  room.fly(another, 5.0, 1.6);
  window = room.look(4.0, 4.0);
  another.see({window, kCamera, room.camera(4.0), Isometry3d::Identity(), kOpening});
  EXPECT_EQ(another.verdict().openness, Openness::kUnknown);

  OpennessJudge third({}, kNeeded);
  room.fly(third, 5.0, 1.6);
  third.reset();
  EXPECT_EQ(third.verdict().log_odds, 0.0);
  EXPECT_FALSE(third.verdict().has_depth);
}

TEST(OpennessJudge, badInputChangesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  OpennessJudge judge({}, kNeeded);
  const Approach room{3.0};
  room.fly(judge, 5.0, 1.6);
  const auto before = judge.verdict();
  auto window = room.look(1.5, 1.9);
  window.corners[1].x() = nan;
  judge.see({window, kCamera, room.camera(1.5), Isometry3d::Identity(), kOpening});
  window = room.look(1.5, 1.9);
  window.stamp_sec = nan;
  judge.see({window, kCamera, room.camera(1.5), Isometry3d::Identity(), kOpening});
  window = room.look(1.5, 1.9);
  Isometry3d broken = room.camera(1.5);
  broken.translation().z() = nan;
  judge.see({window, kCamera, broken, Isometry3d::Identity(), kOpening});
  judge.see({window, kCamera, room.camera(1.5), Isometry3d::Identity(), {nan, 1.0}});
  EXPECT_EQ(judge.verdict().log_odds, before.log_odds);
  EXPECT_EQ(judge.verdict().openness, before.openness);
  window = room.look(1.5, 1.9);
  for (auto& point : window.interior.points) point.now_px.x() = nan;
  judge.see({window, kCamera, room.camera(1.5), Isometry3d::Identity(), kOpening});
  EXPECT_TRUE(std::isfinite(judge.verdict().log_odds));
}

TEST(OpennessJudge, borderThatIsNotTheFilteredWindowsIsNotUsed) {
  OpennessJudge judge({}, kNeeded);
  const Approach room{3.0};
  const geometry::OpeningSize larger{1.5, 1.25};
  for (double plane_m = 5.0; plane_m > 1.6; plane_m -= 0.1) {
    const auto window = room.look(plane_m, 5.0);
    judge.see({window, kCamera, room.camera(plane_m), Isometry3d::Identity(), larger});
  }
  EXPECT_EQ(judge.verdict().log_odds, 0.0);
}

TEST(OpennessJudge, parametersOutOfRangeAreNamed) {
  OpennessParams params;
  params.max_depth_closed_m = 1.5;
  params.sure_log_odds = -1.0;
  try {
    OpennessJudge judge(params, kNeeded);
    FAIL() << "must throw";
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("sure_log_odds"), std::string::npos);
    EXPECT_NE(text.find("min_depth_behind_m"), std::string::npos);
  }
}

// evaluation/openness_survey.hpp covers more than a hundred thousand images with all noise.
TEST(OpennessJudge, nothingClosedIsEverCalledOpen) {
  const evaluation::OpennessRange range;
  for (const Interior interior : {Interior::kPoster, Interior::kPane, Interior::kTilted, Interior::kCurtain,
                                  Interior::kJump, Interior::kDirt})
    for (std::uint32_t seed = 1; seed <= 600; ++seed)
      ASSERT_FALSE(evaluation::flySynthetic(interior, seed, range, {}).ever_open)
          << evaluation::toString(interior) << " " << seed;
}

// One camera cannot detect the pane. But the more a pane reflects, the less often it is judged OPEN.
TEST(OpennessJudge, theMoreAPaneMirrorsTheSeldomerItIsCalledOpen) {
  evaluation::OpennessRange range;
  std::vector<int> open;
  for (const double reflectivity : {0.1, 0.6, 1.0}) {
    range.reflectivity = reflectivity;
    open.push_back(0);
    for (std::uint32_t seed = 1; seed <= 200; ++seed)
      open.back() +=
          evaluation::flySynthetic(Interior::kGlass, seed, range, {}).at_decision.openness == Openness::kOpen;
  }
  EXPECT_GT(open[0], 1.2 * open[1]);
  EXPECT_GT(open[1], 1.2 * open[2]);
}

TEST(OpennessJudge, roomsAreCalledOpenInTimeAndNeverClosed) {
  const evaluation::OpennessRange range;
  int open = 0;
  constexpr int kFlights = 300;
  for (std::uint32_t seed = 1; seed <= kFlights; ++seed) {
    const auto result = evaluation::flySynthetic(Interior::kRoom, seed, range, {});
    open += result.at_decision.openness == Openness::kOpen;
    // Furniture stands in the room from 0.4 of its depth on.
    const bool may_be_blocked = 0.4 * result.room_m < OpennessParams().min_depth_behind_m;
    EXPECT_TRUE(may_be_blocked || !result.ever_closed) << seed;
  }
  EXPECT_GE(open, 0.9 * kFlights);
}

}  // namespace window_ingress::openness::openness_judge_test
