#include "window_ingress/facade/facade_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "window_row.hpp"

namespace window_ingress::facade::facade_memory_test {

using openness::Openness;

/// A façade memory in front of a row of windows, with its own clock.
struct Watch {
  test::WindowRow row;
  FacadeMemory memory{FacadeParams()};
  std::mt19937 random{11};
  double now_sec = 10.0;
  Viewpoint view = test::WindowRow::from({-8.0, -3.8, 1.5});

  /// \param target index in the row of the window that the detector tracks, -1: none
  void look(int images, int target) {
    for (int n = 0; n < images; ++n, now_sec += 0.1) {
      const auto tracked = target < 0 ? std::nullopt : std::optional(row.tracked(target));
      memory.addView(row.look(now_sec, view, target, random), tracked, row.size);
    }
  }
  const KnownWindow& at(int i) const {
    const KnownWindow* nearest = nullptr;
    for (const KnownWindow& window : memory.windows())
      if (nearest == nullptr || (window.place.position_m - row.centre(i)).norm() <
                                    (nearest->place.position_m - row.centre(i)).norm())
        nearest = &window;
    return *nearest;
  }
  std::string whyNot(int i) {
    return memory.whyNotTarget(row.observation(i, now_sec, view, random), view, row.size);
  }
};

TEST(FacadeMemory, TakesTheWindowFollowedForTheTargetAndNoneOfItsNeighbours) {
  Watch watch;
  EXPECT_EQ(watch.whyNot(1), "") << "nothing is known yet";
  watch.look(20, 2);
  ASSERT_NE(watch.memory.target(), nullptr);
  EXPECT_EQ(watch.memory.target(), &watch.at(2));
  EXPECT_FALSE(watch.memory.isChosen());
  EXPECT_EQ(watch.whyNot(2), "");
  for (const int other : {0, 1, 3, 4})
    EXPECT_NE(watch.whyNot(other).find("which is the target"), std::string::npos);
}

TEST(FacadeMemory, RefusesNeighboursAfterALossHoweverLongAndExpectsTheTargetWhereItWas) {
  Watch watch;
  watch.look(20, 2);
  const std::uint32_t target = watch.memory.targetId();
  watch.now_sec += 5.0;
  watch.view = test::WindowRow::from({-8.3, -3.4, 1.6}, 0.1);
  EXPECT_NE(watch.whyNot(1), "");
  EXPECT_EQ(watch.whyNot(2), "");
  const auto expected = watch.memory.expected(watch.view);
  ASSERT_TRUE(expected);
  const auto seen = watch.row.seen(2, watch.view, watch.random);
  EXPECT_LT((geometry::centroid(*expected) - geometry::centroid(seen->corners)).norm(), 5.0);
  watch.look(10, 2);
  EXPECT_EQ(watch.memory.targetId(), target) << "the same number again";
}

TEST(FacadeMemory, ExpectsNothingThatIsNotWhollyInView) {
  Watch watch;
  watch.look(20, 2);
  EXPECT_FALSE(watch.memory.expected(test::WindowRow::from({-6.0, -3.8, 1.5}, 3.0))) << "behind";
  EXPECT_FALSE(watch.memory.expected(test::WindowRow::from({-0.6, -3.8, 1.5}))) << "too near";
}

TEST(FacadeMemory, LetsTheOperatorChooseByNumberOrByAClick) {
  Watch watch;
  watch.look(20, 2);
  const std::uint32_t other = watch.at(3).id;
  EXPECT_TRUE(watch.memory.select(other).success);
  EXPECT_TRUE(watch.memory.isChosen());
  EXPECT_EQ(watch.whyNot(3), "");
  EXPECT_NE(watch.whyNot(2), "") << "though it is followed";
  EXPECT_TRUE(watch.memory.selectNear(watch.row.centre(0) + Eigen::Vector3d(0.1, 0.3, -0.2)).success);
  EXPECT_EQ(watch.memory.target(), &watch.at(0));
  EXPECT_NE(watch.memory.select(77).message.find("no window 77"), std::string::npos);
  EXPECT_FALSE(watch.memory.selectNear({0.0, 5.0, 1.5}).success);
  EXPECT_EQ(watch.memory.target(), &watch.at(0)) << "what was refused changes nothing";
}

// Windows 1 and 3 of the row were never seen side by side. Then the estimate has window 3 at the place of
// window 1.
TEST(FacadeMemory, AChosenWindowStaysTheTargetWhereItTurnsOutToBeOneWithAnOlderOne) {
  Watch watch;
  const auto look = [&](int seen, bool is_target, const std::optional<TrackedWindow>& tracked) {
    for (int n = 0; n < 4; ++n, watch.now_sec += 0.1) {
      auto window = *watch.row.seen(seen, watch.view, watch.random);
      window.is_target = is_target;
      watch.memory.addView({watch.now_sec, watch.view, {window}, is_target ? 7u : 0u}, tracked,
                           watch.row.size);
    }
  };
  look(1, false, std::nullopt);
  look(3, true, std::nullopt);
  ASSERT_EQ(watch.memory.windows().size(), 2u);
  const std::uint32_t younger = watch.memory.windows().back().id;
  ASSERT_TRUE(watch.memory.select(younger).success);
  look(3, true, watch.row.tracked(1));
  EXPECT_EQ(watch.memory.windows().front().id, younger) << "of two numbers the chosen one stays";
  EXPECT_EQ(watch.memory.targetId(), younger);
  EXPECT_TRUE(watch.memory.isChosen());
}

TEST(FacadeMemory, AChoiceIsTakenBackByZero) {
  Watch watch;
  watch.look(20, 2);
  ASSERT_TRUE(watch.memory.select(2).success);
  EXPECT_TRUE(watch.memory.select(0).success);
  EXPECT_FALSE(watch.memory.isChosen());
  EXPECT_EQ(watch.memory.targetId(), 0u);
}

TEST(FacadeMemory, DoesNotLetAClosedWindowBeChosen) {
  Watch watch;
  watch.look(20, 2);
  openness::OpennessVerdict closed;
  closed.openness = Openness::kClosed;
  watch.memory.judge(closed);
  EXPECT_FALSE(watch.memory.select(watch.memory.targetId()).success);
}

TEST(FacadeMemory, GoesOnToTheNextBestOnlyWhereThatIsAllowed) {
  for (const bool allowed : {false, true}) {
    Watch watch;
    watch.look(20, 2);
    const std::uint32_t closed = watch.memory.targetId();
    watch.memory.giveUp({closed}, allowed);
    EXPECT_EQ(watch.memory.targetId() != 0, allowed);
    EXPECT_NE(watch.memory.targetId(), closed);
    watch.look(20, 2);  // the detector still tracks window 2
    EXPECT_NE(watch.memory.targetId(), closed) << "what was given up is not taken up again";
  }
}

TEST(FacadeMemory, TriesEachWindowOnceAndThenNone) {
  Watch watch;
  watch.look(20, 2);
  std::set<std::uint32_t> tried;
  for (int n = 0; n < 5; ++n) {
    EXPECT_TRUE(tried.insert(watch.memory.targetId()).second);
    watch.memory.giveUp({watch.memory.targetId()}, true);
  }
  EXPECT_EQ(watch.memory.targetId(), 0u);
}

TEST(FacadeMemory, NothingTakesThePlaceOfAChosenOneUnlessThatIsAllowed) {
  Watch watch;
  watch.look(20, 2);
  ASSERT_TRUE(watch.memory.select(watch.at(2).id).success);
  watch.memory.giveUp({watch.memory.targetId()}, false);
  EXPECT_NE(watch.whyNot(1).find("search/next_window"), std::string::npos);
  watch.look(60, 1);
  EXPECT_EQ(watch.memory.targetId(), 0u);
  watch.memory.forgetPlaces();
  watch.look(60, 1);
  EXPECT_EQ(watch.memory.targetId(), 0u) << "nor after a jump of the odometry";
  ASSERT_TRUE(watch.memory.select(watch.at(1).id).success);
  EXPECT_EQ(watch.whyNot(1), "");
}

TEST(FacadeMemory, TheNextOneHasTheSizeLookedFor) {
  Watch watch;
  watch.row.count = 1;
  for (int n = 0; n < 20; ++n, watch.now_sec += 0.1) {
    auto look = watch.row.look(watch.now_sec, watch.view, 0, watch.random);
    auto pane = look.windows.front();  // half as large, one metre aside
    const Eigen::Vector2d centre = geometry::centroid(pane.corners);
    for (auto& corner : pane.corners) corner = centre + 0.5 * (corner - centre) + Eigen::Vector2d(60.0, 0.0);
    pane.is_target = false;
    look.windows.push_back(pane);
    watch.memory.addView(look, watch.row.tracked(0), watch.row.size);
  }
  ASSERT_EQ(watch.memory.windows().size(), 2u);
  watch.memory.giveUp({watch.memory.targetId()}, true);
  EXPECT_EQ(watch.memory.targetId(), 0u);
}

TEST(FacadeMemory, ANextOneThatIsNotThereIsFollowedByAnother) {
  Watch watch;
  watch.look(20, 0);
  watch.memory.giveUp({watch.memory.targetId()}, true);
  const std::uint32_t next = watch.memory.targetId();
  ASSERT_NE(next, 0u);
  const auto gone = [&](const detection::SeenWindow& window) {
    const auto place = watch.memory.expected(watch.view);
    return place && (geometry::centroid(window.corners) - geometry::centroid(*place)).norm() < 20.0;
  };
  for (int n = 0; n < 40 && watch.memory.targetId() == next; ++n, watch.now_sec += 0.1) {
    const bool away = n % 3 == 0;  // sometimes it looks elsewhere
    const auto view = away ? test::WindowRow::from({-8.0, -3.8, 1.5}, 2.0) : watch.view;
    auto look = watch.row.look(watch.now_sec, view, -1, watch.random);
    look.windows.erase(std::remove_if(look.windows.begin(), look.windows.end(), gone), look.windows.end());
    watch.memory.addView(look, std::nullopt, watch.row.size);
  }
  EXPECT_NE(watch.memory.targetId(), next);
  EXPECT_NE(watch.memory.targetId(), 0u);
}

TEST(FacadeMemory, YieldsToAWindowThatIsClearlyMoreLikeTheReferenceUnlessItWasChosen) {
  for (const bool is_chosen : {false, true}) {
    Watch watch;
    watch.look(20, 2);
    if (is_chosen) {
      ASSERT_TRUE(watch.memory.select(watch.memory.targetId()).success);
    }
    for (int n = 0; n < 5; ++n, watch.now_sec += 0.1) {
      auto look = watch.row.look(watch.now_sec, watch.view, 2, watch.random);
      for (auto& window : look.windows) {
        window.has_appearance = true;
        window.bhattacharyya = window.corners[0].x() < 150.0 ? 0.1 : 0.45;
      }
      watch.memory.addView(look, std::nullopt, watch.row.size);
    }
    EXPECT_EQ(watch.memory.targetId() != 0, is_chosen);
  }
}

TEST(FacadeMemory, GivesUpATargetThatIsNotThereThoughItsPlaceIsInView) {
  Watch watch;
  watch.look(20, 2);
  watch.row.count = 2;  // the target among those that vanish
  watch.look(60, -1);
  EXPECT_NE(watch.memory.targetId(), 0u) << "a while is not enough";
  watch.look(60, -1);
  EXPECT_EQ(watch.memory.targetId(), 0u);
}

TEST(FacadeMemory, AChoiceIsNotGivenUpWhereItIsNotSeen) {
  Watch watch;
  watch.look(20, 2);
  ASSERT_TRUE(watch.memory.select(watch.at(3).id).success);
  const std::uint32_t chosen = watch.memory.targetId();
  watch.row.count = 3;  // the target among those that vanish
  watch.look(200, 2);
  EXPECT_EQ(watch.memory.targetId(), chosen);
  EXPECT_NE(watch.whyNot(2).find("which is the target"), std::string::npos);
}

TEST(FacadeMemory, AChoiceOutlivesAJumpOfTheOdometryOnlyIfItIsFollowedOn) {
  for (const int followed : {2, 1}) {
    Watch watch;
    watch.look(20, 2);
    ASSERT_TRUE(watch.memory.select(watch.at(2).id).success);
    watch.look(2, 2);
    watch.memory.forgetPlaces();
    watch.look(20, followed);
    EXPECT_EQ(watch.memory.targetId() != 0, followed == 2);
    EXPECT_EQ(watch.whyNot(1).find("choose again") != std::string::npos, followed == 1);
  }
}

TEST(FacadeMemory, CountsVisitsAndFailures) {
  Watch watch;
  watch.look(20, 2);
  const std::uint32_t id = watch.memory.targetId();
  for (const std::uint32_t flown_at : {0u, id, id, 0u, id, 99u}) watch.memory.noteFlownAt(flown_at);
  watch.memory.giveUp({id, 99u}, false);
  EXPECT_EQ(watch.at(2).visits, 2);
  EXPECT_EQ(watch.at(2).failures, 1);
}

TEST(FacadeMemory, SwitchedOffRefusesNothingAndRemembersNothing) {
  FacadeParams off;
  off.enabled = false;
  Watch watch;
  watch.memory = FacadeMemory(off);
  watch.look(30, 2);
  EXPECT_TRUE(watch.memory.windows().empty());
  EXPECT_EQ(watch.whyNot(0), "");
}

TEST(FacadeMemory, RefusesParametersOutOfRange) {
  FacadeParams params;
  params.release_sec = -1.0;
  EXPECT_THROW(FacadeMemory{params}, std::invalid_argument);
}

}  // namespace window_ingress::facade::facade_memory_test
