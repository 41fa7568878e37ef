#include "detection/tracking/appearance_monitor.hpp"

#include <gtest/gtest.h>

#include "drawn_window.hpp"

namespace window_ingress::detection::appearance_monitor_test {

constexpr int kEvery = 4;

struct Watched {
  Watched() {
    params.track.appearance_every = kEvery;
    drawn.width = 320, drawn.height = 240;
    drawn.opening = test::rectangle(80, 60, 240, 180);
    input.image = drawn.draw();
    window.corners = drawn.opening;
    window.corner_visible = {true, true, true, true};
  }
  bool look(AppearanceMonitor& watch) { return watch.look(input, window, true, true); }

  DetectorParams params;
  test::DrawnWindow drawn;
  TrackInput input;
  WindowObservation window;
};

TEST(AppearanceMonitor, LooksOnceInAWhileAndAgreesWithTheReferenceItself) {
  Watched seen;
  AppearanceMonitor watch(seen.params);
  watch.setReference(std::make_shared<ReferenceAppearance>(seen.input.image, seen.drawn.opening));
  watch.start();
  for (int i = 1; i <= 3 * kEvery; ++i) {
    seen.window.has_appearance = false;
    EXPECT_TRUE(seen.look(watch)) << i;
    EXPECT_EQ(seen.window.has_appearance, i % kEvery == 0) << i;
  }
  EXPECT_FALSE(watch.isUnlike());
}

TEST(AppearanceMonitor, AnotherPaintIsUnlikeUntilASearchHasSeenItAgain) {
  Watched seen;
  AppearanceMonitor watch(seen.params);
  watch.setReference(std::make_shared<ReferenceAppearance>(seen.input.image, seen.drawn.opening));
  cv::Mat other;
  const int blue_and_red_swapped[] = {0, 2, 1, 1, 2, 0};
  other.create(seen.input.image.size(), CV_8UC3);
  cv::mixChannels(&seen.input.image, 1, &other, 1, blue_and_red_swapped, 3);
  seen.input.image = other;
  EXPECT_FALSE(seen.look(watch));
  EXPECT_TRUE(watch.isUnlike());
  watch.restart();
  EXPECT_FALSE(watch.isUnlike());
}

TEST(AppearanceMonitor, WithoutAReferenceNothingIsCompared) {
  Watched seen;
  AppearanceMonitor watch(seen.params);
  for (int i = 0; i < 2 * kEvery; ++i) EXPECT_TRUE(seen.look(watch));
  watch.setReference(std::make_shared<ReferenceAppearance>(seen.input.image, seen.drawn.opening));
  watch.setReference(nullptr);
  EXPECT_TRUE(seen.look(watch));
  EXPECT_FALSE(seen.window.has_appearance);
}

TEST(AppearanceMonitor, AWindowThatIsNotWholeIsNotComparedNorLearned) {
  Watched seen;
  AppearanceMonitor watch(seen.params);
  watch.setReference(std::make_shared<ReferenceAppearance>(seen.input.image, seen.drawn.opening));
  seen.window.corner_visible[2] = false;
  EXPECT_TRUE(seen.look(watch));
  EXPECT_FALSE(seen.window.has_appearance);
}

}  // namespace window_ingress::detection::appearance_monitor_test
