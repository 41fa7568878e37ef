#include "detection/alignment/ring_matcher.hpp"

#include <gtest/gtest.h>

#include "patched_wall.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/detection/window_tracker.hpp"

namespace window_ingress::detection::ring_matcher_test {

using geometry::Quadrilateral;
using test::PatchedWall;
using test::seenFrom;

ScoredCandidate rough(const Quadrilateral& quad, double score = 0.7) {
  ScoredCandidate candidate;
  candidate.quad = quad;
  candidate.score = score;
  return candidate;
}

/// A judge that has learned one wall, in front of a view of it.
struct Known {
  explicit Known(const PatchedWall& wall) {
    Quadrilateral corners;
    const cv::Mat reference = wall.draw(seenFrom(2.5, 0.0), &corners);
    judge.learn(reference, corners);
    image = wall.draw(seenFrom(3.5, 0.4), &opening, cv::Scalar(20, 30, 40));
    judge.see(image, nullptr);
  }
  RingMatcher judge;
  cv::Mat image;
  Quadrilateral opening;
};

TEST(RingMatcher, TheRightPlaceComesFirstWhateverItsScoreByGeometry) {
  Known known{PatchedWall(3)};
  std::vector<ScoredCandidate> candidates = {rough(test::rectangle(40, 60, 160, 150), 0.99),
                                             rough(test::grown(known.opening, 3.0), 0.3)};
  const auto& found = known.judge.align(candidates);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(test::worstCorner(found[0].quad, known.opening), 0.25);
  EXPECT_GT(*found[0].correlation, 0.8);
  EXPECT_TRUE(found[0].located);
  EXPECT_LT(found.size() > 1 ? *found[1].correlation : 0.0, 0.5);
}

TEST(RingMatcher, LoopsOfOnePlaceGiveOne) {
  Known known{PatchedWall(3)};
  std::vector<ScoredCandidate> candidates;
  for (double grown : {-3.0, 0.0, 2.0, 4.0}) candidates.push_back(rough(test::grown(known.opening, grown)));
  EXPECT_EQ(known.judge.align(candidates).size(), 1U);
}

TEST(RingMatcher, NothingIsKnownBeforeAReference) { EXPECT_FALSE(RingMatcher().known()); }

TEST(RingMatcher, ThePlaceIsFoundInTheWholeImageWithoutAnyEdge) {
  Known known{PatchedWall(3)};
  auto candidates = known.judge.placesEverywhere();
  ASSERT_FALSE(candidates.empty());
  EXPECT_LE(candidates.size(), 6U);
  const auto& found = known.judge.align(candidates);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(test::worstCorner(found[0].quad, known.opening), 0.25);
}

TEST(RingMatcher, APlaceIsFoundEverywhereThoughTheReferenceEndsBesideTheOpening) {
  const PatchedWall wall(3);
  Quadrilateral corners, opening;
  const cv::Mat reference = wall.draw(seenFrom(2.5, 0.0), &corners);
  const int left = static_cast<int>(corners[0].x()) - 8;
  for (Eigen::Vector2d& corner : corners) corner.x() -= left;
  RingMatcher matcher;
  matcher.learn(reference.colRange(left, reference.cols).clone(), corners);
  const cv::Mat image = wall.draw(seenFrom(3.5, 0.4), &opening, cv::Scalar(20, 30, 40));
  matcher.see(image, nullptr);
  auto candidates = matcher.placesEverywhere();
  const auto& found = matcher.align(candidates);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(test::worstCorner(found[0].quad, opening), 0.5);
}

TEST(RingMatcher, NoPlaceOnAnotherWallFits) {
  Known known{PatchedWall(3)};
  const cv::Mat other = PatchedWall(4).draw(seenFrom(3.5, 0.4), nullptr);
  known.judge.see(other, nullptr);
  auto candidates = known.judge.placesEverywhere();
  for (const ScoredCandidate& place : known.judge.align(candidates))
    EXPECT_LT(*place.correlation, DetectorParams().min_correlation);
}

TEST(RingMatcher, PlacesEverywhereNeedAReferenceAndAnImageLikeIt) {
  Known known{PatchedWall(3)};
  EXPECT_TRUE(RingMatcher().placesEverywhere().empty());
  for (const cv::Mat& image :
       {cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(90)), known.image(cv::Rect(0, 0, 20, 16))}) {
    known.judge.see(image, nullptr);
    EXPECT_TRUE(known.judge.placesEverywhere().empty());
  }
}

// Borders near those of a view of a wall; the left border was placed on something beside it.
std::optional<RefinedBorders> bordersNear(const PatchedWall& reference, const Known& seen, double off_px) {
  Quadrilateral corners, place = seen.opening;
  const cv::Mat image = reference.draw(seenFrom(2.5, 0.0), &corners);
  WindowDetector detector{DetectorParams()};
  detector.setReference(ReferenceAppearance(image, corners));
  place[0].x() -= off_px, place[3].x() -= off_px;
  const geometry::PinholeCamera camera = PatchedWall::lensless();
  return detector.bordersNear(place, seen.image, &camera);
}

TEST(WindowDetector, WhatLiesRoundItLeadsToTheBordersOfAHoleOrAFrame) {
  for (const double frame_m : {0.0, 0.07}) {
    const PatchedWall wall(3, frame_m, 25.0);
    const Known known{wall};
    const auto borders = bordersNear(wall, known, 7.0);
    ASSERT_TRUE(borders) << frame_m;
    EXPECT_LT(test::worstCorner(borders->corners, known.opening), 0.3) << frame_m;
  }
  EXPECT_FALSE(bordersNear(PatchedWall(4, 0.0, 25.0), Known{PatchedWall(3, 0.0, 25.0)}, 7.0))
      << "of another wall";
}

/// Detections in views of a wall whose reference image is known.
struct Detected {
  explicit Detected(const PatchedWall& wall) : detector(DetectorParams()) {
    Quadrilateral corners;
    const cv::Mat image = wall.draw(seenFrom(2.5, 0.0), &corners);
    detector.setReference(ReferenceAppearance(image, corners));
  }
  std::optional<WindowObservation> look(const PatchedWall& wall, double yaw_rad, Quadrilateral* opening) {
    cv::Mat image = wall.draw(seenFrom(3.0, yaw_rad), opening, cv::Scalar(30, 40, 35));
    if (evening) shine(image, *opening);
    if (outlined)
      for (int i = 0; i < 4; ++i) drawLine(image, (*opening)[i], (*opening)[(i + 1) % 4]);
    if (person) cover(image, *opening);
    for (int n = 0; ropes && n < 16; ++n)
      cv::line(image, {100 * n - 60, 0}, {100 * n, 480}, cv::Scalar(30, 120, 230), 12, cv::LINE_AA);
    test::addNoise(image, 2.0, 3);
    const geometry::PinholeCamera camera = PatchedWall::lensless();
    return detector.detect(image, 0.0, &camera);
  }
  // Light of another colour, and a shadow over the right half of the window.
  static void shine(cv::Mat& image, const Quadrilateral& opening) {
    cv::multiply(image, cv::Scalar(0.6, 0.8, 1.1), image);
    const int from = static_cast<int>(geometry::centroid(opening).x());
    cv::Mat dark = image.colRange(from, image.cols);
    dark *= 0.5;
  }
  static void drawLine(cv::Mat& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    cv::line(image, cv::Point2d(a.x(), a.y()), cv::Point2d(b.x(), b.y()), cv::Scalar(40, 40, 40), 2,
             cv::LINE_AA);
  }
  // An occluder covers the right border from top to bottom.
  static void cover(cv::Mat& image, const Quadrilateral& opening) {
    const double x = 0.5 * (opening[1].x() + opening[2].x());
    test::fillQuad(image, test::rectangle(x - 14, opening[1].y() - 40, x + 18, 480), cv::Scalar(120, 60, 90));
  }

  WindowDetector detector;
  bool evening = false, outlined = false, person = false, ropes = false;
};

TEST(WindowDetector, AFrameOfWhichOneSideIsHiddenIsFound) {
  const PatchedWall wall(3, 0.07, 25.0);
  Detected detected(wall);
  detected.person = true;
  for (double yaw : {-0.4, 0.0, 0.4}) {
    Quadrilateral opening;
    const auto window = detected.look(wall, yaw, &opening);
    ASSERT_TRUE(window) << yaw << ": " << detected.detector.trace().detail;
    EXPECT_LT(test::worstCorner(window->corners, opening), 3.0) << yaw;
  }
}

TEST(WindowDetector, AHoleIsFoundBehindRopes) {
  const PatchedWall wall(3, 0.0, 25.0);
  Detected detected(wall);
  detected.ropes = true;
  Quadrilateral opening;
  for (double yaw : {-0.3, 0.3}) {
    const auto window = detected.look(wall, yaw, &opening);
    ASSERT_TRUE(window) << yaw << ": " << detected.detector.trace().detail;
    EXPECT_LT(test::worstCorner(window->corners, opening), 1.5) << yaw;
  }
  EXPECT_FALSE(detected.look(PatchedWall(4, 0.0, 25.0), 0.3, &opening)) << "in another wall";
}

// A wall with a repetitive pattern and a shape like the opening's outline on it.
TEST(WindowDetector, WhereTheWallGoesOnWithinThereIsNoHole) {
  PatchedWall wall(3, 0.0, 25.0);
  Detected detected(wall);
  wall.is_open = false;
  detected.outlined = true;
  for (double yaw : {-0.3, 0.0, 0.3}) {
    Quadrilateral opening;
    EXPECT_FALSE(detected.look(wall, yaw, &opening)) << yaw;
  }
}

TEST(WindowDetector, AFrameInOtherLightIsKnownByItsContrasts) {
  PatchedWall wall(3, 0.07, 15.0);
  Detected detected(wall);
  detected.evening = true;
  for (double yaw : {-0.5, 0.0, 0.5}) {
    Quadrilateral opening;
    const auto window = detected.look(wall, yaw, &opening);
    ASSERT_TRUE(window) << yaw << ": " << detected.detector.trace().detail;
    EXPECT_LT(test::worstCorner(window->corners, opening), 0.5) << yaw;
    wall.paint = cv::Scalar(60, 140, 60);
    EXPECT_FALSE(detected.look(wall, yaw, &opening)) << yaw << ": painted green";
    wall.paint = PatchedWall(3).paint;
  }
}

TEST(WindowDetector, AHoleWithoutAFrameIsKnownByItsWall) {
  const PatchedWall wall(3, 0.0, 25.0);
  Detected detected(wall);
  for (double yaw : {-0.6, -0.3, 0.0, 0.3, 0.6}) {
    Quadrilateral opening;
    const auto window = detected.look(wall, yaw, &opening);
    ASSERT_TRUE(window) << yaw << ": " << detected.detector.trace().detail;
    EXPECT_LT(test::worstCorner(window->corners, opening), 0.3) << yaw;
    EXPECT_GT(window->correlation, 0.7);
    EXPECT_LT(window->runner_up, 0.55) << "nothing else is like it";
  }
}

// The camera approaches from the side: the frame's border is faint next to the back edge of the reveal.
TEST(WindowTracker, ThePaintOfAFrameMayGoOnIntoTheReveal) {
  PatchedWall wall(3, 0.07, 25.0);
  Quadrilateral opening;
  const cv::Mat reference = wall.draw(seenFrom(2.5, 0.0), &opening);
  wall.painted_reveal_m = 0.1;
  WindowTracker tracker{DetectorParams()};
  tracker.setReference(ReferenceAppearance(reference, opening));
  const geometry::PinholeCamera camera = PatchedWall::lensless();
  for (int i = 0; i < 24; ++i) {
    TrackInput input;
    input.image = wall.draw(seenFrom(3.2 - 0.04 * i, 0.35), &opening, cv::Scalar(30, 40, 35));
    test::addNoise(input.image, 2.0, 3 + i);
    input.stamp_sec = 10.0 + i / 30.0;
    input.camera = &camera;
    const auto window = tracker.update(input);
    ASSERT_TRUE(window && window->whole()) << i << ": " << tracker.trace().detail;
    if (i < 5) continue;
    EXPECT_LT(test::worstCorner(window->corners, opening), 1.0) << i;
  }
}

TEST(RingMatcher, TellsHowWellAPlaceFits) {
  Known known{PatchedWall(3)};
  const auto right = known.judge.alignedAt(test::grown(known.opening, 2.0), RingMatcher::kFoundStartPx);
  ASSERT_TRUE(right);
  EXPECT_GT(right->correlation, 0.8);
  const auto wrong = known.judge.alignedAt(test::rectangle(40, 60, 160, 150), RingMatcher::kFoundStartPx);
  EXPECT_LT(wrong ? wrong->correlation : 0.0, 0.5);
}

TEST(RingMatcher, AnUnsharpViewIsNotAPaleOne) {
  const PatchedWall wall(3);
  Known known(wall);
  Quadrilateral opening;
  const cv::Mat sharp = wall.draw(seenFrom(6.0, 0.4), &opening, cv::Scalar(20, 30, 40));
  cv::Mat unsharp, pale;
  cv::GaussianBlur(sharp, unsharp, cv::Size(), 2.2);
  sharp.convertTo(pale, -1, 0.45, 60.0);
  const auto judged = [&](const cv::Mat& image) {
    known.judge.see(image, nullptr);
    const auto ring = known.judge.alignedAt(opening, RingMatcher::kFoundStartPx);
    return ring ? known.judge.judged(ring->quad) : RingMatch();
  };
  const RingMatch blurred = judged(unsharp), faded = judged(pale);
  EXPECT_LT(blurred.contrast, 0.7);
  EXPECT_GT(blurred.faithful, 0.8) << "0.56 at the image's own resolution";
  EXPECT_GT(faded.correlation, 0.0);
  EXPECT_LT(faded.contrast, 0.7);
  EXPECT_LT(faded.faithful, 0.75);
}

TEST(WindowDetector, AHoleInAnotherWallIsNotTheTarget) {
  Detected detected(PatchedWall(3, 0.0, 25.0));
  Quadrilateral opening;
  EXPECT_FALSE(detected.look(PatchedWall(4, 0.0, 25.0), 0.2, &opening));
  EXPECT_EQ(detected.detector.trace().outcome, RejectReason::kUnlike);
}

TEST(WindowDetector, AWallThatWasClosedIsNoWindow) {
  PatchedWall wall(3, 0.0, 25.0);
  Detected detected(wall);
  wall.is_open = false;
  for (double yaw : {-0.3, 0.0, 0.3}) EXPECT_FALSE(detected.look(wall, yaw, nullptr)) << yaw;
}

}  // namespace window_ingress::detection::ring_matcher_test
