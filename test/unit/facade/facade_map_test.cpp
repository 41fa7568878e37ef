#include "window_ingress/facade/facade_map.hpp"

#include <gtest/gtest.h>

#include "window_row.hpp"

namespace window_ingress::facade::facade_map_test {

const Wall kWall{{0.0, 0.0, 1.5}, 0.0, 0.02, 0.01};

/// A path along the row, looking at it, with or without a known wall.
void walkAlong(FacadeMap& map, const test::WindowRow& row, const std::optional<Wall>& wall, double begin_sec,
               unsigned seed) {
  std::mt19937 random(seed);
  for (int n = 0; n < 60; ++n)
    map.addView(row.look(begin_sec + 0.1 * n, row.from({-5.0, 1.0 - 0.15 * n, 1.5}), -1, random), wall,
                row.size);
}

int confirmed(const FacadeMap& map) {
  int count = 0;
  for (const KnownWindow& window : map.windows()) count += window.isConfirmed();
  return count;
}

TEST(FacadeMap, GivesEachOfEqualWindowsOneNumberAndKeepsIt) {
  const test::WindowRow row;
  for (const bool knows_wall : {true, false}) {
    FacadeMap map{FacadeParams()};
    walkAlong(map, row, knows_wall ? std::optional(kWall) : std::nullopt, 10.0, 1);
    ASSERT_EQ(confirmed(map), 5) << knows_wall;
    const auto before = map.windows();
    walkAlong(map, row, knows_wall ? std::optional(kWall) : std::nullopt, 30.0, 2);
    ASSERT_EQ(confirmed(map), 5) << knows_wall;
    for (const KnownWindow& window : before) {
      const KnownWindow* now = map.find(window.id);
      ASSERT_NE(now, nullptr);
      EXPECT_LT((now->place.position_m - window.place.position_m).norm(), knows_wall ? 0.05 : 0.8);
    }
  }
}

TEST(FacadeMap, FindsAWindowAgainWhereItWasAfterALossAlthoughOdometryDrifted) {
  std::mt19937 random(5);
  const test::WindowRow row;
  FacadeMap map{FacadeParams()};
  walkAlong(map, row, kWall, 10.0, 3);
  const auto before = map.windows();
  for (int n = 0; n < 4; ++n) {  // ten seconds later and 6 cm aside
    auto look = row.look(26.0 + 0.1 * n, row.from({-5.0, -2.0, 1.5}), -1, random);
    look.from.T_odom_camera.translation() += Eigen::Vector3d(0.0, 0.06, 0.0);
    map.addView(look, kWall, row.size);
  }
  EXPECT_EQ(map.windows().size(), before.size());
}

TEST(FacadeMap, FindsAWindowAgainWhereNoOtherOneCanBeHoweverFarOdometrySlid) {
  std::mt19937 random(5);
  const test::WindowRow row;
  FacadeMap map{FacadeParams()};
  walkAlong(map, row, kWall, 10.0, 3);
  const auto before = map.windows();
  for (int n = 0; n < 10; ++n) {  // at once, by 0.35 m
    auto look = row.look(16.0 + 0.1 * n, row.from({-5.0, -2.0, 1.5}), -1, random);
    look.from.T_odom_camera.translation() += Eigen::Vector3d(0.0, 0.35, 0.0);
    map.addView(look, kWall, row.size);
  }
  EXPECT_EQ(map.windows().size(), before.size());
}

TEST(FacadeMap, ForgetsWhatWasSeenButOnce) {
  std::mt19937 random(6);
  const test::WindowRow row;
  FacadeMap map{FacadeParams()};
  auto look = row.look(10.0, row.from({-5.0, 0.0, 1.5}), -1, random);
  map.addView(look, kWall, row.size);
  EXPECT_FALSE(map.windows().empty());
  EXPECT_EQ(confirmed(map), 0);
  map.addView({13.0, look.from, {}, 0}, kWall, row.size);
  EXPECT_TRUE(map.windows().empty());
}

TEST(FacadeMap, NumbersNothingThatWasSeenButOnce) {
  std::mt19937 random(8);
  const test::WindowRow row;
  FacadeMap map{FacadeParams()};
  for (double stamp_sec = 10.0; stamp_sec < 40.0; stamp_sec += 3.0)
    map.addView(row.look(stamp_sec, row.from({-5.0, 0.0, 1.5}), -1, random), kWall, row.size);
  walkAlong(map, row, kWall, 50.0, 1);
  std::uint32_t highest = 0;
  for (const KnownWindow& window : map.windows()) highest = std::max(highest, window.id);
  EXPECT_EQ(highest, 5u);
}

TEST(FacadeMap, TakesTwoThatComeToLieInOnePlaceForOneUnlessTheyWereSeenSideBySide) {
  std::mt19937 random(7);
  test::WindowRow row;
  row.count = 1;
  FacadeMap map{FacadeParams()};
  // At first the window is placed as far away as a window of three times its size; later the wall is known.
  for (int n = 0; n < 5; ++n)
    map.addView(row.look(10.0 + 0.1 * n, row.from({-5.0, 0.0, 1.5}), -1, random), std::nullopt, {3.6, 3.0});
  for (int n = 0; n < 40; ++n)
    map.addView(row.look(11.0 + 0.1 * n, row.from({-5.0, 1.0 - 0.05 * n, 1.5}), -1, random), kWall, row.size);
  ASSERT_GE(map.windows().size(), 1u);
  EXPECT_NE(map.at({row.centre(0), 1e-4 * Eigen::Matrix3d::Identity(), 0.0, row.size, true}, 15.0), nullptr);
  FacadeMap near{FacadeParams()};
  test::WindowRow pair;
  pair.count = 2, pair.spacing_m = 1.25;
  walkAlong(near, pair, kWall, 10.0, 8);
  EXPECT_EQ(confirmed(near), 2);
}

// Windows 0 and 1 are seen side by side, later 2 alone. Window 2 turns out to be 1, and then to stand at the
// place of 0.
TEST(FacadeMap, WhatWasSeenBesideAWindowStaysApartFromTheOneThatItBecomes) {
  std::mt19937 random(9);
  test::WindowRow row;
  const Viewpoint view = row.from({-8.0, -2.0, 1.5});
  const auto look = [&](FacadeMap& map, double begin_sec, std::initializer_list<int> shown) {
    for (int n = 0; n < 4; ++n) {
      FacadeView seen{begin_sec + 0.1 * n, view, {}, 0};
      for (const int i : shown) seen.windows.push_back(*row.seen(i, view, random));
      map.addView(seen, kWall, row.size);
    }
  };
  const auto placed = [&](int i) {
    return WindowPlace{row.centre(i), 1e-4 * Eigen::Matrix3d::Identity(), 0.0, row.size, true};
  };
  FacadeMap map{FacadeParams()};
  look(map, 10.0, {2});
  look(map, 11.0, {0, 1});
  ASSERT_EQ(confirmed(map), 3);
  const std::uint32_t oldest = map.windows()[0].id, beside = map.windows()[1].id;
  map.find(oldest)->place = placed(1);
  look(map, 12.0, {});
  ASSERT_EQ(confirmed(map), 2) << "2 is 1";
  map.find(oldest)->place = placed(0);
  look(map, 13.0, {});
  EXPECT_NE(map.find(beside), nullptr) << "0 was seen beside it";
}

TEST(FacadeMap, DoesNotTakeAPaneForItsWindow) {
  std::mt19937 random(10);
  test::WindowRow row, panes;
  row.count = panes.count = 1;
  panes.size = {0.7, 0.6};
  FacadeMap map{FacadeParams()};
  for (int n = 0; n < 30; ++n) {
    const auto view = row.from({-5.0, 0.5 - 0.03 * n, 1.5});
    map.addView((n % 3 == 0 ? panes : row).look(10.0 + 0.1 * n, view, -1, random), kWall, row.size);
  }
  ASSERT_EQ(map.windows().size(), 2u);
  for (const KnownWindow& window : map.windows())
    EXPECT_NEAR(window.place.size.width_m, window.sights > 15 ? 1.2 : 0.7, 0.06);
}

TEST(FacadeMap, BeforeThereIsAWallNumbersOnlyWhatMayBeTheTarget) {
  std::mt19937 random(14);
  const test::WindowRow row;
  FacadeMap map{FacadeParams()};
  const auto see = [&](double begin_sec, const std::optional<Wall>& wall) {
    for (int n = 0; n < 20; ++n) {
      auto look = row.look(begin_sec + 0.1 * n, row.from({-5.0, -2.0, 1.5}), -1, random);
      for (auto& seen : look.windows) seen.may_be_target = &seen == &look.windows.front();
      map.addView(look, wall, row.size);
    }
  };
  see(10.0, std::nullopt);
  EXPECT_EQ(confirmed(map), 1);
  const auto seen = map.windows().size();
  see(12.0, kWall);
  EXPECT_EQ(confirmed(map), static_cast<int>(seen))
      << "neighbours in its wall are listed, whatever their look";
}

TEST(FacadeMap, WhatIsLessThanHalfAsWideOrHighAsTheOneLookedForIsNoWindow) {
  std::mt19937 random(12);
  const test::WindowRow row;
  for (const geometry::OpeningSize& size : {geometry::OpeningSize{0.24, 1.06}, {1.2, 0.2}}) {
    test::WindowRow strips;
    strips.size = size;
    FacadeMap map{FacadeParams()};
    for (int n = 0; n < 20; ++n)
      map.addView(strips.look(10.0 + 0.1 * n, row.from({-5.0, -2.0, 1.5}), -1, random), kWall, row.size);
    EXPECT_TRUE(map.windows().empty());
  }
}

// Detected by its outer border, and so placed too near.
TEST(FacadeMap, ForgetsWhatWasGuessedAndIsNotThereButNotOutOfViewNorTheTarget) {
  std::mt19937 random(13);
  test::WindowRow row, outer;
  outer.size = {2.4, 2.0};
  const auto look = [&](FacadeMap& map, const test::WindowRow& what, const std::optional<Wall>& wall,
                        double begin_sec, double heading_rad, std::uint32_t kept) {
    const auto view = row.from({-7.0, -1.9, 1.5}, heading_rad);
    for (int n = 0; n < 120; ++n)
      map.addView(what.look(begin_sec + 0.1 * n, view, -1, random), wall, row.size, kept);
  };
  FacadeMap before{FacadeParams()};
  look(before, outer, std::nullopt, 10.0, 0.0, 0);
  const int guessed = confirmed(before);
  ASSERT_GT(guessed, 0);
  ASSERT_LT(before.windows()[0].place.position_m.x(), -2.0);
  FacadeMap seen = before, aside = before, kept = before;
  look(seen, row, kWall, 22.0, 0.0, 0);
  EXPECT_EQ(confirmed(seen), 4) << "those in view";
  for (const KnownWindow& window : seen.windows()) EXPECT_TRUE(window.place.on_wall) << window.id;
  look(aside, row, kWall, 22.0, 1.2, 0);
  EXPECT_EQ(confirmed(aside), guessed);
  const std::uint32_t target = before.windows()[0].id;
  look(kept, row, kWall, 22.0, 0.0, target);
  EXPECT_NE(kept.find(target), nullptr);
}

TEST(FacadeMap, AWindowCutOffByTheImageIsTheOneThatWasSeenByItsFramesOuterBorder) {
  std::mt19937 random(15);
  test::WindowRow cut, outer;
  cut.count = outer.count = 1;
  cut.size = {0.92, 0.95}, outer.size = {1.34, 1.06};
  FacadeMap map{FacadeParams()};
  for (int n = 0; n < 30; ++n)
    map.addView((n % 3 == 0 ? outer : cut).look(10.0 + 0.1 * n, cut.from({-5.0, 0.0, 1.5}), -1, random),
                kWall, {1.2, 1.0});
  EXPECT_EQ(map.windows().size(), 1u);
}

TEST(FacadeMap, DoesNotTakeALargeLoopForTheWindowBehindIt) {
  std::mt19937 random(11);
  test::WindowRow row, loop;
  row.count = loop.count = 1;
  loop.size = {4.0, 3.3};  // as far away as 1.5 m if it had the expected size
  FacadeMap map{FacadeParams()};
  for (int n = 0; n < 20; ++n)
    map.addView((n < 10 ? loop : row).look(10.0 + 0.1 * n, row.from({-5.0, 0.0, 1.5}), -1, random),
                std::nullopt, row.size);
  ASSERT_EQ(confirmed(map), 2);
  EXPECT_NEAR(map.windows().back().place.position_m.x(), 0.0, 0.3);
}

TEST(FacadeMap, KeepsItsSizeHoweverMuchIsSeen) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> anywhere(0.0, 600.0);
  FacadeMap map{FacadeParams()};
  const auto view = test::WindowRow::from({-5.0, 0.0, 1.5});
  for (int n = 0; n < 2000; ++n) {
    FacadeView look{10.0 + 0.01 * n, view, {}, 0};
    for (int i = 0; i < 12; ++i) {
      const double x = anywhere(random), y = 0.7 * anywhere(random);
      detection::SeenWindow window;
      window.corners = {Eigen::Vector2d(x, y), Eigen::Vector2d(x + 30, y), Eigen::Vector2d(x + 30, y + 30),
                        Eigen::Vector2d(x, y + 30)};
      look.windows.push_back(window);
    }
    map.addView(look, kWall, {1.2, 1.0});
  }
  EXPECT_LE(map.windows().size(), 64u);
  for (const KnownWindow& window : map.windows()) EXPECT_TRUE(window.place.position_m.allFinite());
}

TEST(FacadeMap, AFullMapForgetsWhatItHasNotSeenForLongestButNotTheTarget) {
  const test::WindowRow row;
  std::mt19937 random(10);
  FacadeMap map{FacadeParams()};
  const Viewpoint at_first = test::WindowRow::from({-5.0, 0.0, 1.5});
  std::uint32_t kept = 0;
  for (int part = 0; part < 60; ++part)  // of a wall that is 1,800 m wide
    for (int n = 0; n < 5; ++n) {
      FacadeView view = row.look(10.0 + part + 0.1 * n, at_first, -1, random);
      view.from = test::WindowRow::from({-5.0, 30.0 * part, 1.5});
      map.addView(view, kWall, row.size, kept);
      if (part == 0 && n == 4) kept = map.windows().front().id;
    }
  EXPECT_LE(map.windows().size(), 64u);
  EXPECT_NE(kept, 0u);
  EXPECT_NE(map.find(kept), nullptr);
  EXPECT_EQ(map.find(kept + 1), nullptr) << "of the first part, too";
  EXPECT_NE(map.windows().back().id, 0u) << "of the last part";
}

}  // namespace window_ingress::facade::facade_map_test
