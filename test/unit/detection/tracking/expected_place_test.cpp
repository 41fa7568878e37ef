/// How the tracker uses the place at which another part expects the target.
#include <gtest/gtest.h>

#include "flat_facade.hpp"
#include "window_ingress/detection/window_tracker.hpp"

namespace window_ingress::detection::expected_place_test {

using test::FlatFacade;

const geometry::PinholeCamera kCamera = geometry::PinholeCamera::fromFieldOfView(480, 360, 1.2);

/// Three equal windows, seen by a camera that stands still in front of the middle one.
struct Row {
  FlatFacade wall{3, 1.7, 1.2, 1.0, 0.07};
  FlatFacade::Camera from{{1.7, 0.0, -5.0}};
  WindowTracker tracker{DetectorParams()};
  int frame = 0;

  Row() { tracker.setReference({wall.see(from, kCamera, 1000), corners(1)}); }
  geometry::Quadrilateral corners(int window) const { return *wall.corners(window, from, kCamera); }
  std::optional<WindowObservation> look(const std::optional<geometry::Quadrilateral>& expected) {
    TrackInput input;
    input.image = wall.see(from, kCamera, static_cast<unsigned>(frame));
    input.stamp_sec = 10.0 + frame / 30.0;
    input.camera = &kCamera;
    input.expected = expected;
    ++frame;
    return tracker.update(input);
  }
  double off(const std::optional<WindowObservation>& seen, int window) const {
    return seen ? test::worstCorner(seen->corners, corners(window)) : 1e9;
  }
};

TEST(ExpectedPlace, ChoosesTheWindowAmongEqualOnesFromTheFirstImage) {
  for (int window = 0; window < 3; ++window) {
    Row row;
    int whole = 0;
    for (int n = 0; n < 12; ++n) {
      const auto seen = row.look(row.corners(window));
      if (!seen || !seen->whole()) continue;
      EXPECT_LT(row.off(seen, window), 2.0) << window;
      ++whole;
    }
    EXPECT_GE(whole, 9) << window;
  }
}

TEST(ExpectedPlace, EndsATrackOfAnotherWindowAfterAFewImagesAndTheNewOneHasANumberOfItsOwn) {
  Row row;
  for (int n = 0; n < 10; ++n) row.look(row.corners(0));
  const auto before = row.look(row.corners(0));
  ASSERT_LT(row.off(before, 0), 2.0);
  EXPECT_LT(row.off(row.look(row.corners(2)), 0), 2.0) << "one image is not believed";
  for (int n = 0; n < 8; ++n) row.look(row.corners(2));
  const auto after = row.look(row.corners(2));
  ASSERT_LT(row.off(after, 2), 2.0);
  EXPECT_NE(after->target_id, before->target_id);
}

TEST(ExpectedPlace, IsWaitedForAndNothingElseIsTaken) {
  Row row;
  const auto empty_wall = test::rectangle(190, 20, 290, 100);
  for (int n = 0; n < 90; ++n) EXPECT_FALSE(row.look(empty_wall)) << n;
  EXPECT_TRUE(row.look(std::nullopt).has_value() || row.look(std::nullopt).has_value() || [&] {
    for (int n = 0; n < 90; ++n)
      if (row.look(std::nullopt)) return true;
    return false;
  }()) << "expected no longer, any window is one";
}

TEST(ExpectedPlace, KeepsTheNumberOverALossOfSeconds) {
  Row row;
  for (int n = 0; n < 10; ++n) row.look(row.corners(1));
  const auto before = row.look(row.corners(1));
  ASSERT_TRUE(before);
  row.frame += 150;
  const auto after = row.look(row.corners(1));
  ASSERT_LT(row.off(after, 1), 2.0);
  EXPECT_EQ(after->target_id, before->target_id);
}

TEST(ExpectedPlace, ThatIsNoQuadrilateralIsNotHeeded) {
  Row row;
  const Eigen::Vector2d nan(std::nan(""), 1.0), point(5.0, 5.0);
  for (int n = 0; n < 10; ++n) {
    EXPECT_TRUE(row.look(geometry::Quadrilateral{nan, point, point, point}) || n < 2);
    EXPECT_TRUE(row.look(geometry::Quadrilateral{point, point, point, point}) || n < 2);
  }
}

TEST(AllWindows, OfTheImageAreToldAboutOnceASecondWhileOneIsFollowed) {
  Row row;
  int told = 0, most = 0, targets = 0;
  for (int n = 0; n < 90; ++n) {
    row.look(row.corners(1));
    const auto& windows = row.tracker.windows();
    targets += !windows.empty() && windows.front().is_target;
    if (n >= 30) told += windows.size() > 1;
    most = std::max(most, static_cast<int>(windows.size()));
  }
  EXPECT_GE(targets, 80);
  EXPECT_EQ(most, 3);
  EXPECT_GE(told, 2);
  EXPECT_LE(told, 4) << "each of them is a search";
}

}  // namespace window_ingress::detection::expected_place_test
