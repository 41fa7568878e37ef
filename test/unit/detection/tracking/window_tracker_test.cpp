#include "window_ingress/detection/window_tracker.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <map>

#include "drawn_window.hpp"
#include "flat_facade.hpp"

namespace window_ingress::detection::window_tracker_test {

using geometry::Quadrilateral;
using test::DrawnWindow;
using test::FlatFacade;

constexpr double kPeriodSec = 1.0 / 30.0;

const geometry::PinholeCamera& camera() {
  static const auto camera = geometry::PinholeCamera::fromFieldOfView(480, 360, 1.2);
  return camera;
}

TrackInput inputOf(const cv::Mat& image, int frame) {
  TrackInput input;
  input.image = image;
  input.stamp_sec = 10.0 + kPeriodSec * frame;
  return input;
}

TrackInput viewOf(const FlatFacade& wall, const FlatFacade::Camera& from, int frame) {
  TrackInput input = inputOf(wall.see(from, camera(), frame), frame);
  input.camera = &camera();
  input.R_world_camera = from.R_world_camera();
  return input;
}

/// The window was tracked without a search.
bool followed(const WindowTracker& tracker) { return tracker.tracking() && tracker.trace().segments == 0; }

DrawnWindow windowAt(double x, double y, double half, double frame_px, int frame) {
  DrawnWindow drawn;
  drawn.width = 320, drawn.height = 240;
  drawn.opening = test::turned(test::rectangle(x - 1.2 * half, y - half, x + 1.2 * half, y + half), 0.0, 0.1);
  drawn.frame_px = frame_px;
  drawn.seed = 1 + frame;
  return drawn;
}

TEST(WindowTracker, FollowsAMovingWindowToATenthOfAPixelUnderOneNumber) {
  WindowTracker tracker{DetectorParams()};
  int searches = 0;
  double squares = 0.0;
  const int frames = 50;
  for (int i = 0; i < frames; ++i) {
    DrawnWindow drawn = windowAt(150 + 30 * std::sin(0.05 * i), 115 + 12 * std::sin(0.08 * i), 40.0 + 0.4 * i,
                                 6.0 + 0.06 * i, i);
    drawn.opening = test::turned(drawn.opening, 0.05 * std::sin(0.1 * i), 0.0);
    const auto window = tracker.update(inputOf(drawn.draw(), i));
    ASSERT_TRUE(window) << i << ": " << tracker.trace().detail;
    ASSERT_TRUE(window->whole()) << i;
    EXPECT_EQ(window->target_id, 1u);
    EXPECT_LT(test::worstCorner(window->corners, drawn.opening), 0.3) << i;
    for (int k = 0; k < 4; ++k)
      squares += (window->corners[k] - drawn.opening[k]).squaredNorm() / (8.0 * frames);
    searches += !followed(tracker);
  }
  EXPECT_LE(searches, 2);
  EXPECT_LT(std::sqrt(squares), 0.05) << "RMS a coordinate [px]";
}

// The frame is as wide as the window's jump: the outer border moves to the inner border's former place.
TEST(WindowTracker, DoesNotSlipToTheOtherBorderOfItsFrame) {
  WindowTracker tracker{DetectorParams()};
  for (int i = 0; i < 40; ++i) {
    const double jump = 4.0 * (i / 4 % 2);
    const DrawnWindow drawn = windowAt(150 + jump, 115 - jump, 50.0, 4.0, i);
    const auto window = tracker.update(inputOf(drawn.draw(), i));
    ASSERT_TRUE(window) << i << ": " << tracker.trace().detail;
    EXPECT_LT(test::worstCorner(window->corners, drawn.opening), 0.4) << i;
  }
}

TEST(WindowTracker, AWindowThatVanishesIsGivenUpInTheSameFrame) {
  WindowTracker tracker{DetectorParams()};
  const DrawnWindow drawn = windowAt(150, 115, 50.0, 6.0, 0);
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(tracker.update(inputOf(drawn.draw(), i)));
  cv::Mat wall(240, 320, CV_8UC3, drawn.wall);
  test::addNoise(wall, 2.0, 5);
  EXPECT_FALSE(tracker.update(inputOf(wall, 10)));
  EXPECT_FALSE(tracker.tracking());
  EXPECT_FALSE(tracker.trace().detail.empty());
  const auto again = tracker.update(inputOf(drawn.draw(), 11));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->target_id, 1u) << "in its place and soon: the same";
}

TEST(WindowTracker, ASideThatIsHiddenIsNoEdgeAndTheRestGoesOn) {
  WindowTracker tracker{DetectorParams()};
  const DrawnWindow drawn = windowAt(150, 115, 50.0, 6.0, 0);
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(tracker.update(inputOf(drawn.draw(), i)));
  cv::Mat hidden = drawn.draw();
  hidden(cv::Rect(195, 30, 60, 180)).setTo(cv::Scalar(90, 200, 90));
  const auto window = tracker.update(inputOf(hidden, 8));
  ASSERT_TRUE(window) << tracker.trace().detail;
  EXPECT_FALSE(window->whole());
  EXPECT_EQ(window->visibleSides(), 3);
  EXPECT_FALSE(window->edges[geometry::kRight].visible);
  EXPECT_FALSE(window->corner_visible[geometry::kTopRight]);
  EXPECT_EQ(window->corners[geometry::kTopRight], Eigen::Vector2d(0, 0));
  EXPECT_LT((window->corners[geometry::kTopLeft] - drawn.opening[0]).norm(), 0.3);
}

// The side is too near to the image's edge to be learned when the window is found.
TEST(WindowTracker, ASideThatComesIntoViewLaterIsFollowedToo) {
  WindowTracker tracker{DetectorParams()};
  int whole = 0;
  for (int i = 0; i < 20; ++i) {
    const DrawnWindow drawn = windowAt(61.3 + 2.0 * i, 115, 50.0, 6.0, i);
    const auto window = tracker.update(inputOf(drawn.draw(), i));
    ASSERT_TRUE(window) << i << ": " << tracker.trace().detail;
    EXPECT_EQ(window->target_id, 1u);
    whole += i > 0 && window->whole();
  }
  EXPECT_GE(whole, 15);
}

/// Largest distance of the visible edges' ends from the true sides [px].
double worstEdge(const WindowObservation& window, const Quadrilateral& truth) {
  double worst = 0.0;
  for (int i = 0; i < 4; ++i) {
    if (!window.edges[i].visible) continue;
    const Eigen::Vector2d along = (truth[(i + 1) % 4] - truth[i]).normalized(), normal(along.y(), -along.x());
    for (const Eigen::Vector2d& end : {window.edges[i].a, window.edges[i].b})
      worst = std::max(worst, std::abs(normal.dot(end - truth[i])));
  }
  return worst;
}

TEST(WindowTracker, SidesThatLeaveTheViewRemainEdgesAndNoCornerIsInvented) {
  const FlatFacade wall(1, 4.0, 1.2, 1.0, 0.06);
  WindowTracker tracker{DetectorParams()};
  double last_m = 9.0;
  int partial = 0;
  for (int i = 0; i < 85; ++i) {
    FlatFacade::Camera from;
    from.position_m = {0.35, -0.35 + 0.0005 * i, -3.0 + 0.03 * i};
    from.yaw_rad = 0.03 * std::sin(0.2 * i), from.pitch_rad = 0.02 * std::cos(0.25 * i);
    const auto truth = wall.corners(0, from, camera()).value();
    const auto window = tracker.update(viewOf(wall, from, i));
    if (!window) continue;
    last_m = -from.position_m.z();
    EXPECT_EQ(window->target_id, 1u);
    EXPECT_GE(window->visibleSides(), 2);
    const double limit_px =
        0.2 + 0.003 * camera().fx / last_m;  // the wall is painted in blurred pixels of 5 mm
    EXPECT_LT(worstEdge(*window, truth), limit_px) << i;
    partial += !window->whole();
    for (int k = 0; k < 4; ++k) {
      if (window->corner_visible[k]) {
        EXPECT_TRUE(camera().contains(truth[k], -1.0)) << i;
        EXPECT_LT((window->corners[k] - truth[k]).norm(), 1.5 * limit_px) << i;
      } else {
        EXPECT_EQ(window->corners[k], Eigen::Vector2d(0, 0));
      }
    }
  }
  EXPECT_GT(partial, 15);
  EXPECT_LT(last_m, 0.55) << "seen until near the plane";
}

/// Index of the façade's window in this observation, or -1.
int shown(const FlatFacade& wall, const FlatFacade::Camera& from, const WindowObservation& window) {
  for (int k = 0; k < wall.count(); ++k) {
    const auto truth = wall.corners(k, from, camera());
    if (truth && window.whole() && geometry::intersectionOverUnion(window.corners, *truth) > 0.5) return k;
  }
  return -1;
}

// A row of equal windows. The camera moves past them and turns, and some images are lost.
TEST(WindowTracker, InARowOfEqualWindowsANumberNeverChangesItsWindow) {
  const FlatFacade wall(3, 1.5, 1.0, 0.9, 0.06);
  for (int seed = 1; seed <= 4; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    WindowTracker tracker{DetectorParams()};
    FlatFacade::Camera photographer;
    photographer.position_m = {0, 0, -2.5};
    tracker.setReference(ReferenceAppearance(wall.see(photographer, camera(), seed),
                                             wall.corners(0, photographer, camera()).value()));
    std::map<std::uint32_t, int> window_of;
    const double speed = 0.6 + 0.6 * uniform(random), phase = 6.0 * uniform(random);
    int hidden_until = 0, seen = 0;
    for (int i = 0; i < 100; ++i) {
      FlatFacade::Camera from;
      from.position_m = {speed * kPeriodSec * i, 0.1 * std::sin(0.1 * i), -4.5 + 0.01 * i};
      from.yaw_rad = 0.25 * std::sin(0.06 * i + phase), from.roll_rad = 0.05 * std::sin(0.11 * i);
      TrackInput input = viewOf(wall, from, i);
      if (seed % 2 == 0) input.R_world_camera.reset();
      if (uniform(random) < 0.03) hidden_until = i + 1 + static_cast<int>(12 * uniform(random));
      if (i < hidden_until) input.image.setTo(cv::Scalar(120, 120, 120));
      const auto window = tracker.update(input);
      if (!window) continue;
      const int which = shown(wall, from, *window);
      if (which < 0) continue;
      ++seen;
      const auto known = window_of.emplace(window->target_id, which).first;
      ASSERT_EQ(known->second, which)
          << "number " << window->target_id << ", frame " << i << ", seed " << seed;
    }
    EXPECT_GT(seen, 50) << seed;
  }
}

TEST(WindowTracker, WaitsForALostWindowBeforeItTakesAnotherOneUnderANewNumber) {
  WindowTracker tracker{DetectorParams()};
  const cv::Mat left = windowAt(100, 115, 40.0, 6.0, 0).draw(),
                right = windowAt(220, 115, 40.0, 6.0, 1).draw();
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(tracker.update(inputOf(left, i)));
  int first = 0;
  for (int i = 10; i < 60 && first == 0; ++i)
    if (const auto window = tracker.update(inputOf(right, i))) {
      first = i;
      EXPECT_EQ(window->target_id, 2u);
    } else {
      EXPECT_NE(tracker.trace().detail.find("waiting for"), std::string::npos) << tracker.trace().detail;
      EXPECT_EQ(tracker.trace().target, -1);
    }
  EXPECT_NEAR((first - 9) * kPeriodSec, TrackParams().reacquire_sec, 2 * kPeriodSec);
}

TEST(WindowTracker, TimeSizeAndCalibrationStartAnew) {
  WindowTracker tracker{DetectorParams()};
  const cv::Mat image = windowAt(150, 115, 50.0, 6.0, 0).draw();
  geometry::PinholeCamera one = geometry::PinholeCamera::fromFieldOfView(320, 240, 1.2), other = one;
  other.fx += 1.0;
  const auto numberAt = [&](int frame, const geometry::PinholeCamera* model, const cv::Mat& shown) {
    TrackInput input = inputOf(shown, frame);
    input.camera = model;
    const auto window = tracker.update(input);
    return window ? window->target_id : 0u;
  };
  EXPECT_EQ(numberAt(0, &one, image), 1u);
  EXPECT_EQ(numberAt(1, &one, image), 1u);
  EXPECT_EQ(numberAt(0, &one, image), 2u) << "back in time";
  EXPECT_EQ(numberAt(0, &one, image), 3u) << "the same time again";
  EXPECT_EQ(numberAt(60, &one, image), 4u) << "a gap";
  EXPECT_EQ(numberAt(61, &other, image), 5u) << "another calibration";
  EXPECT_EQ(numberAt(62, nullptr, image), 6u) << "none any more";
  tracker.reset();
  EXPECT_EQ(numberAt(63, nullptr, image), 7u) << "asked to";
  cv::Mat larger;
  cv::copyMakeBorder(image, larger, 0, 20, 0, 20, cv::BORDER_REPLICATE);
  EXPECT_EQ(numberAt(64, nullptr, larger), 8u) << "another size";
}

/// A window of this paint; it moves a little in each frame.
cv::Mat painted(const cv::Scalar& paint, int frame, DrawnWindow* drawn = nullptr) {
  DrawnWindow window = windowAt(150 + 10 * std::sin(0.05 * frame), 115, 42, 6, frame);
  window.frame = paint;
  if (drawn) *drawn = window;
  return window.draw();
}

ReferenceAppearance referenceOf(const cv::Scalar& paint) {
  DrawnWindow drawn;
  const cv::Mat image = painted(paint, 0, &drawn);
  return {image, drawn.opening};
}

const cv::Scalar kOrange(40, 130, 220), kTinted(110, 150, 190), kBlue(210, 110, 40);

TEST(WindowTracker, ItsReferenceFollowsTheLightSlowlyAndNotFar) {
  DetectorParams params;
  params.track.appearance_every = 5;
  WindowTracker tracker(params);
  tracker.setReference(referenceOf(kOrange));
  int found = 0;
  std::optional<WindowObservation> window;
  for (int i = 0; i < 240; ++i) {
    const double part = i / 240.0;
    window = tracker.update(inputOf(painted((1.0 - part) * kOrange + part * kTinted, i), i));
    if (!window) continue;
    ++found;
    EXPECT_EQ(window->target_id, 1u);
  }
  EXPECT_EQ(found, 240) << "its looks alone never end a track";
  ASSERT_TRUE(window);
  tracker.setReference(referenceOf(kOrange));
  const auto afresh = tracker.update(inputOf(painted(kTinted, 240), 240));
  EXPECT_LT(window->bhattacharyya, 0.9 * (afresh ? afresh->bhattacharyya : 1.0))
      << "a new one is as it is given";
}

TEST(WindowTracker, AnotherWindowNeverBecomesTheReference) {
  WindowTracker tracker{DetectorParams()};
  tracker.setReference(referenceOf(kOrange));
  for (int i = 0; i < 60; ++i) {
    EXPECT_FALSE(tracker.update(inputOf(painted(kBlue, i), i))) << i;
  }
  EXPECT_TRUE(tracker.update(inputOf(painted(kOrange, 60), 60)));
}

TEST(WindowTracker, BadImagesAndNumbersAreRefused) {
  WindowTracker tracker{DetectorParams()};
  const cv::Mat good = windowAt(150, 115, 50.0, 6.0, 0).draw();
  ASSERT_TRUE(tracker.update(inputOf(good, 0)));
  for (const cv::Mat& image :
       {cv::Mat(), cv::Mat(240, 320, CV_16UC1, cv::Scalar(9)), cv::Mat(1, 1, CV_8UC1)}) {
    EXPECT_FALSE(tracker.update(inputOf(image, 1)));
    EXPECT_EQ(tracker.trace().outcome, RejectReason::kBadImage);
  }
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 2; i < 8; ++i) {
    TrackInput input = inputOf(good, i);
    input.R_world_camera = Eigen::Matrix3d::Constant(kNan);
    input.expected = Quadrilateral{Eigen::Vector2d(kNan, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(1, 1),
                                   Eigen::Vector2d(0, 1)};
    const auto window = tracker.update(input);
    ASSERT_TRUE(window) << i;
    EXPECT_TRUE(geometry::isFinite(window->corners));
  }
  TrackInput timeless = inputOf(good, 9);
  timeless.stamp_sec = kNan;
  tracker.update(timeless);
  EXPECT_FALSE(tracker.tracking());
}

TEST(WindowTracker, RefusesBadParameters) {
  DetectorParams params;
  params.track.reacquire_gate = -1.0;
  EXPECT_THROW(WindowTracker{params}, std::invalid_argument);
  WindowTracker tracker{DetectorParams()};
  EXPECT_THROW(tracker.setParams(params), std::invalid_argument);
}

TEST(WindowTracker, TheSameImagesGiveTheSameAnswers) {
  WindowTracker a{DetectorParams()}, b{DetectorParams()};
  b.update(inputOf(windowAt(120, 100, 40.0, 0.0, 3).draw(), -100));
  b.reset();
  for (int i = 0; i < 12; ++i) {
    const cv::Mat image = windowAt(150 + i, 115, 50.0, 6.0, i).draw();
    const auto x = a.update(inputOf(image, i)), y = b.update(inputOf(image, i));
    ASSERT_TRUE(x && y);
    for (int k = 0; k < 4; ++k) EXPECT_EQ(x->corners[k], y->corners[k]);
    EXPECT_EQ(x->score, y->score);
  }
}

}  // namespace window_ingress::detection::window_tracker_test
