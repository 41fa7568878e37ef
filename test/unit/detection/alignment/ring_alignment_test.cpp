#include "detection/alignment/ring_alignment.hpp"

#include <gtest/gtest.h>

#include <random>

#include "patched_wall.hpp"

namespace window_ingress::detection::ring_alignment_test {

using geometry::Quadrilateral;
using test::PatchedWall;
using test::seenFrom;

/// A reference image, and views of the same wall.
struct Scene {
  explicit Scene(const PatchedWall& drawn) : wall(drawn) {
    Quadrilateral opening;
    const cv::Mat image = wall.draw(seenFrom(2.5, 0.0), &opening);
    model.learn(image, opening);
  }
  void look(const Eigen::Isometry3d& from, cv::Scalar within = cv::Scalar(20, 40, 30)) {
    image = wall.draw(from, &opening, within);
    test::addNoise(image, 2.0, 7);
  }
  double found(double off_px, double coarsest_px = 15.0) {
    RingAlignment alignment;
    alignment.set(model, image, nullptr);
    Quadrilateral start = opening;
    start[0] += Eigen::Vector2d(off_px, -off_px), start[2] += Eigen::Vector2d(-0.5 * off_px, off_px);
    const auto aligned = alignment.align(start, 400.0, coarsest_px);
    if (!aligned) return 1e9;
    correlation = aligned->correlation;
    match = alignment.judge(aligned->quad, 200.0);
    return test::worstCorner(aligned->quad, opening);
  }

  PatchedWall wall;
  RingModel model;
  cv::Mat image;
  Quadrilateral opening;
  double correlation = 0.0;
  RingMatch match;
};

TEST(RingAlignment, FindsTheCornersOfAHoleWithoutAFrameToAFractionOfAPixel) {
  Scene scene{PatchedWall(3)};
  for (double yaw : {-0.6, 0.0, 0.6})
    for (double distance : {2.0, 3.5, 6.0}) {
      scene.look(seenFrom(distance, yaw, 0.1, -0.05));
      EXPECT_LT(scene.found(4.0), 0.25) << distance << " m, " << yaw << " rad";
      EXPECT_GT(scene.correlation, 0.8);
    }
}

TEST(RingAlignment, ANearStartNeedsNoCoarseLevels) {
  Scene scene{PatchedWall(3)};
  for (double distance : {2.5, 5.0}) {
    scene.look(seenFrom(distance, 0.3));
    EXPECT_LT(scene.found(2.0, 100.0), 0.15) << distance << " m";
  }
}

TEST(RingAlignment, ADimViewIsJudgedWhereItsNoiseAveragesOut) {
  Scene scene{PatchedWall(3, 0.07, 25.0)};
  scene.look(seenFrom(4.5, 0.3));
  scene.image.convertTo(scene.image, -1, 0.13);
  test::addNoise(scene.image, 2.0, 5);
  EXPECT_LT(scene.found(3.0), 0.5);
  EXPECT_GT(scene.match.faithful_uncovered, 0.88) << "0.77 at the resolution of all others";
}

TEST(RingAlignment, WhatLiesWithinTheOpeningCountsNothing) {
  Scene scene{PatchedWall(3, 0.07)};
  scene.look(seenFrom(3.0, 0.3), cv::Scalar(250, 240, 230));
  EXPECT_LT(scene.found(3.0), 0.25);
  const double bright = scene.correlation;
  scene.look(seenFrom(3.0, 0.3), cv::Scalar(0, 0, 0));
  EXPECT_LT(scene.found(3.0), 0.25);
  EXPECT_NEAR(scene.correlation, bright, 0.03);
}

TEST(RingAlignment, ACastShadowAcrossTheRingChangesNothing) {
  Scene scene{PatchedWall(5)};
  scene.look(seenFrom(2.5, 0.2));
  for (int y = 0; y < scene.image.rows; ++y)
    for (int x = 0; x < scene.image.cols; ++x)
      if (x + y / 2 < 420) {
        cv::Vec3b& pixel = scene.image.at<cv::Vec3b>(y, x);
        pixel = cv::Vec3b(cv::saturate_cast<uchar>(0.55 * pixel[0]), cv::saturate_cast<uchar>(0.5 * pixel[1]),
                          cv::saturate_cast<uchar>(0.45 * pixel[2]));
      }
  EXPECT_LT(scene.found(3.0), 0.2);
  EXPECT_GT(scene.correlation, 0.7);
}

TEST(RingAlignment, AThirdOfTheRingMayBeCovered) {
  Scene scene{PatchedWall(6)};
  scene.look(seenFrom(2.5, -0.2));
  test::fillQuad(scene.image,
                 test::rectangle(0, geometry::centroid(scene.opening).y(), scene.opening[0].x() + 60, 480),
                 cv::Scalar(40, 90, 60));
  EXPECT_LT(scene.found(3.0), 0.3);
  EXPECT_GT(scene.correlation, 0.5);
  EXPECT_GT(scene.match.faithful_uncovered, scene.match.faithful + 0.1) << "what is not covered fits";
}

// Something crosses each segment of the ring, so that none fits as a whole.
TEST(RingAlignment, WhatCrossesAllOfTheRingIsLeftOut) {
  Scene scene{PatchedWall(6)};
  scene.look(seenFrom(2.5, -0.2));
  for (int n = 0; n < 12; ++n)
    cv::line(scene.image, {60 * n - 60, 0}, {60 * n, 480}, cv::Scalar(30, 120, 230), 7);
  EXPECT_LT(scene.found(3.0), 0.5);
  EXPECT_LT(scene.match.faithful, 0.75);
  EXPECT_GT(scene.match.faithful_uncovered, 0.9);
  Scene other{PatchedWall(4)};
  other.look(seenFrom(2.5, -0.2));
  RingAlignment alignment;
  alignment.set(scene.model, other.image, nullptr);
  EXPECT_LT(alignment.judge(other.opening, 200.0).faithful_uncovered, 0.6) << "nothing fits another wall";
}

TEST(RingAlignment, WhatStandsBeforeTheRingIsLeftOutFromTheBeginningWhereItIsExpected) {
  for (unsigned seed : {3, 6}) {
    Scene scene{PatchedWall(seed)}, other{PatchedWall(seed + 1)};
    const auto look = [](Scene& at) {
      at.look(seenFrom(2.5, -0.2));
      for (int n = 0; n < 16; ++n)
        cv::line(at.image, {50 * n - 60, 0}, {50 * n, 480}, cv::Scalar(30, 120, 230), 9);
    };
    look(scene), look(other);
    RingAlignment plain, covered;
    plain.set(scene.model, scene.image, nullptr);
    covered.setCovered(true);
    covered.set(scene.model, scene.image, nullptr);
    EXPECT_LT(plain.correlation(scene.opening, 200.0), 0.58) << seed;
    EXPECT_GT(covered.correlation(scene.opening, 200.0), 0.6) << seed;
    covered.set(scene.model, other.image, nullptr);
    EXPECT_LT(covered.correlation(other.opening, 200.0), 0.5) << seed << ", another wall";
  }
}

// An occluder hides the left side; its edge looks like a border.
TEST(RingAlignment, WhatIsKnownOfTheCameraKeepsAHiddenSideFromShearing) {
  const geometry::PinholeCamera camera = PatchedWall::lensless();
  for (unsigned seed : {3, 9}) {
    Scene scene{PatchedWall(seed)};
    scene.look(seenFrom(2.5, -0.2));
    test::fillQuad(scene.image, test::rectangle(0, 0, scene.opening[0].x() + 30, 480),
                   cv::Scalar(40, 90, 60));
    const auto worst = [&](const std::optional<OpeningAspect>& aspect, const geometry::PinholeCamera* known) {
      scene.model.aspect = aspect;
      RingAlignment alignment;
      alignment.set(scene.model, scene.image, known);
      Quadrilateral start = scene.opening;
      start[0].x() += 12.0, start[3].x() += 12.0;
      const auto aligned = alignment.align(start, 400.0, 15.0);
      return aligned ? test::worstCorner(aligned->quad, scene.opening) : 1e9;
    };
    const OpeningAspect aspect{PatchedWall::kAspect, 0.01};
    EXPECT_LT(worst(aspect, &camera), 0.3) << seed;
    EXPECT_LT(worst(aspect, nullptr), 3.0) << seed << ", of a camera without a calibration";
    EXPECT_GT(worst(std::nullopt, &camera), 10.0) << seed;
  }
}

// An occluder within the opening hides the left side; its edge looks like a border.
TEST(RingAlignment, AHiddenSideIsPlacedByTheThreeOthers) {
  const geometry::PinholeCamera camera = PatchedWall::lensless();
  for (unsigned seed : {3, 9}) {
    Scene scene{PatchedWall(seed, 0.07)};
    scene.model.aspect = OpeningAspect{PatchedWall::kAspect, 0.01};
    scene.look(seenFrom(2.5, -0.3));
    RingAlignment alignment;
    alignment.set(scene.model, scene.image, &camera);
    EXPECT_FALSE(alignment.uncovered(scene.opening, 200.0)) << "nothing hides it";
    Quadrilateral seen = scene.opening;
    seen[0].x() += 16.0, seen[3].x() += 16.0;
    test::fillQuad(scene.image, test::rectangle(0, 0, seen[3].x(), 480), cv::Scalar(40, 90, 60));
    alignment.set(scene.model, scene.image, &camera);
    const auto found = alignment.uncovered(seen, 200.0);
    ASSERT_TRUE(found) << seed;
    EXPECT_EQ(found->hidden, 3);
    EXPECT_LT(test::worstCorner(found->quad, scene.opening), 3.0) << seed;
    EXPECT_GT(found->sides[3].px, 1.0) << "and said to be less sure";
    const auto whole = alignment.completed(scene.opening, 3);
    ASSERT_TRUE(whole);
    EXPECT_LT(test::worstCorner(*whole, scene.opening), 0.3);
  }
}

// Somebody in a patterned coat covers a third of the ring.
TEST(RingAlignment, WhatStandsBeforeOneSideDoesNotPullWhereTheShapeIsKnown) {
  const geometry::PinholeCamera camera = PatchedWall::lensless();
  for (unsigned seed = 3; seed < 9; ++seed) {
    Scene scene{PatchedWall(seed)};
    scene.model.aspect = OpeningAspect{PatchedWall::kAspect, 0.01};
    scene.look(seenFrom(2.5, -0.2));
    std::mt19937 random(seed);
    const int left = static_cast<int>(scene.opening[0].x()) - 60;
    for (int y = 0; y < 480; y += 24)
      for (int x = left; x < left + 100; x += 20)
        cv::rectangle(scene.image, {x, y, 20, 24}, cv::Scalar(random() % 256, random() % 256, random() % 256),
                      cv::FILLED);
    RingAlignment alignment;
    alignment.set(scene.model, scene.image, &camera);
    Quadrilateral start = scene.opening;
    for (auto& corner : start) corner.x() += 5.0;
    const auto aligned = alignment.align(start, 400.0, 15.0);
    ASSERT_TRUE(aligned) << seed;
    EXPECT_LT(test::worstCorner(aligned->quad, scene.opening), 1.5) << seed;
  }
}

// Squared errors of the sides over their stated variances, in many views.
TEST(RingAlignment, WhatIsSaidOfTheSidesIsHonest) {
  Scene scene{PatchedWall(3)};
  scene.model.aspect = OpeningAspect{PatchedWall::kAspect, 0.01};
  const geometry::PinholeCamera camera = PatchedWall::lensless();
  double squares = 0.0;
  int count = 0;
  for (double yaw = -0.6; yaw < 0.65; yaw += 0.1)
    for (double distance : {2.2, 3.0, 4.5}) {
      scene.look(seenFrom(distance, yaw, 0.1 * yaw, 0.02));
      RingAlignment alignment;
      alignment.set(scene.model, scene.image, &camera);
      const auto aligned = alignment.align(test::grown(scene.opening, 2.0), 400.0, 15.0);
      ASSERT_TRUE(aligned);
      for (int i = 0; i < 4; ++i) {
        const Eigen::Vector2d along = (scene.opening[(i + 1) % 4] - scene.opening[i]).normalized();
        const Eigen::Vector2d off = 0.5 * (aligned->quad[i] + aligned->quad[(i + 1) % 4] - scene.opening[i] -
                                           scene.opening[(i + 1) % 4]);
        const double across = off.x() * along.y() - off.y() * along.x();
        ASSERT_TRUE(aligned->sides[i].known());
        EXPECT_LT(aligned->sides[i].px, 0.3);
        squares += std::pow(across / aligned->sides[i].px, 2), ++count;
      }
    }
  EXPECT_GT(squares / count, 0.1);
  EXPECT_LT(squares / count, 2.0);
}

TEST(RingAlignment, TheSideOfAFrameFromBeyondWhichTheCameraLooksIsNotKnown) {
  Scene scene{PatchedWall(3, 0.07)};
  scene.model.aspect = OpeningAspect{PatchedWall::kAspect, 0.01};
  scene.look(seenFrom(2.5, 0.5));
  const geometry::PinholeCamera camera = PatchedWall::lensless();
  const auto known = [&](const geometry::PinholeCamera* with) {
    RingAlignment alignment;
    alignment.set(scene.model, scene.image, with);
    const auto aligned = alignment.align(scene.opening, 400.0, 15.0);
    EXPECT_TRUE(aligned);
    return std::count_if(aligned->sides.begin(), aligned->sides.end(),
                         [](const SideSigma& side) { return side.known(); });
  };
  EXPECT_EQ(known(&camera), 4);
  EXPECT_EQ(known(nullptr), 4) << "a camera without a calibration";
  scene.model.framed = true;
  EXPECT_EQ(known(&camera), 3);
}

TEST(RingAlignment, ASideWhoseRingTheImageCutsOffIsNotKnown) {
  Scene scene{PatchedWall(3)};
  scene.model.aspect = OpeningAspect{PatchedWall::kAspect, 0.01};
  scene.look(seenFrom(2.5, 0.0));
  const int cut = static_cast<int>(std::min(scene.opening[0].x(), scene.opening[3].x())) - 5;
  scene.image = scene.image.colRange(cut, scene.image.cols).clone();
  for (Eigen::Vector2d& corner : scene.opening) corner.x() -= cut;
  RingAlignment alignment;
  alignment.set(scene.model, scene.image, nullptr);
  const auto aligned = alignment.align(scene.opening, 400.0, 100.0);
  ASSERT_TRUE(aligned);
  for (int side = 0; side < 4; ++side) EXPECT_EQ(aligned->sides[side].known(), side != 3) << side;
}

TEST(RingAlignment, HazeTakesContrast) {
  Scene scene{PatchedWall(7)};
  scene.look(seenFrom(3.0, 0.2));
  scene.found(2.0);
  EXPECT_NEAR(scene.match.contrast, 1.0, 0.2);
  scene.image = 0.3 * scene.image + cv::Scalar::all(150);
  scene.found(2.0);
  EXPECT_LT(scene.match.contrast, 0.6 * scene.match.correlation);
}

TEST(RingAlignment, ExposureAndWhiteBalanceChangeNothing) {
  Scene scene{PatchedWall(7)};
  scene.look(seenFrom(3.0, 0.2));
  cv::multiply(scene.image, cv::Scalar(0.8, 0.6, 0.5), scene.image);
  EXPECT_LT(scene.found(3.0), 0.25);
  EXPECT_GT(scene.correlation, 0.8);
}

TEST(RingAlignment, AnotherWallDoesNotFit) {
  Scene scene{PatchedWall(3)}, other{PatchedWall(4)};
  for (double yaw : {-0.4, 0.0, 0.4}) {
    other.look(seenFrom(3.0, yaw));
    RingAlignment alignment;
    alignment.set(scene.model, other.image, nullptr);
    const auto aligned = alignment.align(other.opening, 400.0, 15.0);
    EXPECT_LT(aligned ? aligned->correlation : 0.0, 0.4);
    EXPECT_LT(alignment.correlation(other.opening, 28.0), 0.3);
  }
}

TEST(RingAlignment, LensesAreSeenThrough) {
  Scene scene{PatchedWall(8)};
  geometry::PinholeCamera camera = PatchedWall::lensless();
  scene.look(seenFrom(2.5, 0.3));
  camera.distortion = {-0.25, 0.06, 0.0, 0.0, 0.0};
  cv::Mat x(scene.image.size(), CV_32F), y(scene.image.size(), CV_32F), bent;
  for (int row = 0; row < x.rows; ++row)
    for (int column = 0; column < x.cols; ++column) {
      const Eigen::Vector2d ideal = camera.undistort(Eigen::Vector2d(column, row));
      x.at<float>(row, column) = static_cast<float>(ideal.x()),
                       y.at<float>(row, column) = static_cast<float>(ideal.y());
    }
  cv::remap(scene.image, bent, x, y, cv::INTER_CUBIC);
  Quadrilateral seen = scene.opening, start;
  for (int i = 0; i < 4; ++i)
    seen[i] = camera.distort(seen[i]), start[i] = seen[i] + Eigen::Vector2d(3.0, -2.0);
  RingAlignment alignment;
  alignment.set(scene.model, bent, &camera);
  const auto aligned = alignment.align(start, 400.0, 15.0);
  ASSERT_TRUE(aligned);
  EXPECT_LT(test::worstCorner(aligned->quad, seen), 0.25);
}

TEST(RingModel, WhatTheReferenceDoesNotShowIsLeftOut) {
  Quadrilateral opening;
  const cv::Mat image = PatchedWall(3).draw(seenFrom(2.5, 0.0), &opening);
  const int top = static_cast<int>(opening[0].y()) - 4;  // almost no wall above the opening
  Quadrilateral cut = opening;
  for (auto& corner : cut) corner.y() -= top;
  RingModel whole, part;
  whole.learn(image, opening);
  part.learn(image.rowRange(top, image.rows), cut);
  ASSERT_TRUE(whole.known() && part.known());
  EXPECT_LT(part.level(24.0).size(), 0.85 * whole.level(24.0).size());
  EXPECT_GT(part.level(24.0).size(), 0.5 * whole.level(24.0).size());
  for (float y : part.level(24.0).y) EXPECT_GT(y, -0.6F);
}

TEST(RingModel, NothingIsLearnedFromWhatIsNoImage) {
  RingModel model;
  model.learn(cv::Mat(), test::rectangle(0, 0, 10, 10));
  EXPECT_FALSE(model.known());
  model.learn(cv::Mat(100, 100, CV_8UC3), {Eigen::Vector2d(20, 20), Eigen::Vector2d(80, 80),
                                           Eigen::Vector2d(80, 20), Eigen::Vector2d(20, 80)});
  EXPECT_FALSE(model.known());
}

}  // namespace window_ingress::detection::ring_alignment_test
