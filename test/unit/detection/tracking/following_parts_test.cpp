/// The parts of the tracker, one by one.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

#include "detection/borders/lines.hpp"
#include "detection/borders/subpixel_border.hpp"
#include "detection/tracking/edge_template.hpp"
#include "detection/tracking/edge_tracker.hpp"
#include "detection/tracking/quad_motion.hpp"
#include "detection/tracking/quad_tracker.hpp"
#include "detection/tracking/track_memory.hpp"
#include "drawn_window.hpp"

namespace window_ingress::detection::following_parts_test {

using Eigen::Vector2d;
using geometry::Quadrilateral;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Horizontal bands from the top; each colour begins at its row.
cv::Mat bands(const std::vector<std::pair<double, cv::Scalar>>& from, double noise = 1.0) {
  cv::Mat image(200, 300, CV_8UC3, from.front().second);
  for (const auto& [row, colour] : from) test::fillQuad(image, test::rectangle(-5, row, 305, 205), colour);
  cv::GaussianBlur(image, image, cv::Size(), 0.7);
  test::addNoise(image, noise, 3);
  return image;
}

EdgeProfiles across(const cv::Mat& image, double row, int reach = 14) {
  EdgeProfiles profiles;
  profiles.sample(image, nullptr, {Vector2d(40, row), Vector2d(260, row), 40, 0.06, reach});
  return profiles;
}

const cv::Scalar kWall(150, 165, 175), kFrame(50, 140, 215), kHole(60, 55, 50), kReveal(110, 150, 190);

TEST(EdgeProfiles, OffsetsCountOutwardsAndTheImageGoesOnBeyondItsBorder) {
  const EdgeProfiles profiles = across(bands({{0, kWall}, {100, kHole}}), 100);
  EXPECT_EQ(profiles.insideCount(), 40);
  EXPECT_GT(profiles.samples(7, 2)[2 * profiles.reach()], 150) << "above: the wall";
  EXPECT_LT(profiles.samples(7, 2)[0], 80) << "below: the hole";
  EXPECT_LT((profiles.point(0, 3) - Vector2d(150, 97)).norm(), 1e-9);
  const EdgeProfiles high = across(bands({{0, kWall}, {100, kHole}}), 4);
  EXPECT_EQ(high.insideCount(), 40);
  EXPECT_NEAR(high.samples(3, 0)[2 * high.reach()], kWall[0], 8.0);
  EXPECT_EQ(across(bands({{0, kWall}}), -30).insideCount(), 0);
  EXPECT_EQ(across(bands({{0, kWall}}), kNan).insideCount(), 0);
}

TEST(EdgeProfiles, ALensBendsThePathNotTheImage) {
  auto lens = geometry::PinholeCamera::fromFieldOfView(300, 200, 1.4);
  lens.distortion = {-0.25, 0.06, 0.001, -0.002, 0.0};
  cv::Mat ramp(200, 300, CV_8UC1);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 300; ++x) ramp.at<uchar>(y, x) = static_cast<uchar>(y);
  EdgeProfiles profiles;
  profiles.sample(ramp, &lens, {Vector2d(40, 60), Vector2d(260, 60), 20, 0.0, 8});
  for (int i = 0; i < 20; ++i)
    for (int o : {-8, -3, 0, 5, 8})
      EXPECT_NEAR(profiles.samples(i, 0)[8 + o], lens.distort(profiles.point(profiles.position(i), o)).y(),
                  0.01);
}

TEST(SubpixelBorder, SpreadIsHonestForNoise) {
  double squares = 0.0;
  const int trials = 60;
  for (int seed = 0; seed < trials; ++seed) {
    const double row = 100.0 + 0.013 * seed;
    cv::Mat image = bands({{0, kWall}, {row, kHole}}, 0.0);
    test::addNoise(image, 12.0, 50 + seed);
    const EdgeProfiles profiles = across(image, 100, 6);
    SubpixelBorder fit;
    fit.project(profiles, Eigen::Vector3f(90, 110, 125).normalized());
    FittedBorder border;
    ASSERT_TRUE(fit.run({2.5, 1e3, 0.6}, border));
    squares += std::pow((border.line.at(border.middle()) + row - 100.0) / border.sigma_px, 2) / trials;
  }
  EXPECT_GT(squares, 0.3);
  EXPECT_LT(squares, 3.0);
}

TEST(EdgeTemplate, KnowsTheInnerFromTheOuterBorderWhereverTheyLie) {
  EdgeTemplate inner;
  EXPECT_FALSE(inner.match(across(bands({{0, kWall}}), 100), 6, 100.0)) << "nothing learned";
  inner.learn(across(bands({{0, kWall}, {95, kFrame}, {100, kHole}}), 100), {}, 6, 100.0, 1.0);
  for (double shift : {-5.0, -2.0, 0.0, 3.0, 5.0}) {
    const cv::Mat moved = bands({{0, kWall}, {95 + shift, kFrame}, {100 + shift, kHole}});
    const auto match = inner.match(across(moved, 100), 6, 100.0);
    ASSERT_TRUE(match);
    EXPECT_NEAR(match->line.offset, -shift, 1.0);
    EXPECT_GT(match->similarity, 0.8);
  }
  const auto nearer = inner.match(across(bands({{0, kWall}, {90, kFrame}, {100, kHole}}), 100), 6, 200.0);
  ASSERT_TRUE(nearer);
  EXPECT_NEAR(nearer->line.offset, 0.0, 1.0);
  const auto plain = inner.match(across(bands({{0, kWall}}), 100), 6, 100.0);
  EXPECT_TRUE(!plain || plain->similarity < 0.4);
  EXPECT_FALSE(inner.match(across(bands({{0, kWall}}), -30), 6, 100.0)) << "outside";
}

Stretch stretchAt(double row) { return {Vector2d(40, row), Vector2d(260, row)}; }
Line lineAt(double row, double sigma_px) { return {Vector2d(150, row), Vector2d(0, -1), sigma_px, 1e-4}; }

// The front edge of a reveal is invisible. Its back edge comes nearer, and with it the border.
TEST(EdgeTracker, AnEdgeBesideTheBorderIsReportedAsTheBorder) {
  const auto image = [](double row) { return bands({{0, kWall}, {row, kHole}}); };
  EdgeTracker tracker;
  tracker.learn({image(100), nullptr}, stretchAt(100), 100.0);
  EXPECT_NEAR(tracker.follow({image(100), nullptr}, stretchAt(100), 100.0, 1.0).line.point.y(), 100.0, 0.1);
  ASSERT_TRUE(tracker.keepApart(lineAt(98.2, 0.2), 100.0, 2.5));
  for (const double size_px : {100.0, 120.0}) {
    const double border = 101.0 - 1.8 * std::pow(size_px / 100.0, 2);
    const auto followed = tracker.follow({image(101), nullptr}, stretchAt(border + 0.5), size_px, 1.0);
    ASSERT_TRUE(followed.fitted);
    EXPECT_NEAR(followed.line.point.y(), border, 0.1) << size_px;
    EXPECT_GT(followed.line.sigma_px, 0.2 * size_px / 100.0);
  }
  EXPECT_FALSE(tracker.keepApart(lineAt(96.0, 0.2), 100.0, 2.5)) << "another edge";
}

TEST(EdgeTracker, WhereABorderShowsNoEdgeTheNearestOneIsFollowedForIt) {
  const cv::Mat image = bands({{0, kWall}, {100, kHole}});
  EdgeTracker tracker;
  tracker.learnNear({image, nullptr}, stretchAt(97), 100.0);
  const auto followed = tracker.follow({image, nullptr}, stretchAt(97), 100.0, 1.0);
  ASSERT_TRUE(followed.fitted);
  EXPECT_NEAR(followed.line.point.y(), 97.0, 0.2);
}

// Borders found 5 px above the tracked top edge, with almost no other information about them.
TEST(QuadTracker, WhereTheImageEndsBesideASideItsOwnEdgeIsBelieved) {
  for (const double top : {10.0, 70.0}) {
    test::DrawnWindow drawn;
    drawn.width = 320, drawn.height = 240;
    drawn.opening = test::rectangle(80, top, 240, top + 120);
    const cv::Mat image = drawn.draw();
    QuadTracker tracker;
    QuadMotion motion;
    motion.start(drawn.opening, 0.3);
    tracker.learn({image, nullptr}, drawn.opening, false);
    motion.predict(Eigen::Matrix3d::Identity(), 0.033, {1, 1, 1});
    ASSERT_TRUE(tracker.follow({image, nullptr}, motion));
    ASSERT_EQ(tracker.fitted(), 4);
    RefinedBorders borders;
    borders.corners = drawn.opening;
    borders.corners[0].y() -= 5.0, borders.corners[1].y() -= 5.0;
    borders.fitted.fill(true);
    borders.known.fill({1.0, 0.01});
    EXPECT_EQ(tracker.realign({image, nullptr}, borders, motion), top > 50.0) << top;
  }
}

TEST(StretchInView, IsCutByTheImage) {
  const cv::Mat image(240, 320, CV_8UC1);
  const auto cut = stretchInView({Vector2d(-100, 50), Vector2d(500, 50)}, {image, nullptr}, 3.0);
  ASSERT_TRUE(cut);
  EXPECT_NEAR(cut->from.x(), 3.0, 1e-9);
  EXPECT_NEAR(cut->to.x(), 316.0, 1e-9);
  EXPECT_FALSE(stretchInView({Vector2d(-100, -50), Vector2d(500, -50)}, {image, nullptr}, 3.0));
  EXPECT_FALSE(stretchInView({Vector2d(9, 9), Vector2d(9, 9)}, {image, nullptr}, 3.0));
  EXPECT_FALSE(stretchInView({Vector2d(kNan, 9), Vector2d(9, 9)}, {image, nullptr}, 3.0));
  auto lens = geometry::PinholeCamera::fromFieldOfView(320, 240, 1.4);
  lens.distortion = {-0.3, 0.05, 0, 0, 0};
  const auto bent = stretchInView({Vector2d(-4000, 60), Vector2d(4000, 60)}, {image, &lens}, 3.0);
  ASSERT_TRUE(bent) << "far outside, the lens model folds back";
  EXPECT_TRUE(lens.contains(lens.distort(bent->from)) && lens.contains(lens.distort(bent->to)));
}

TEST(LineCorners, CovarianceIsThatOfManyDraws) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  Line a{{100, 50}, Vector2d(0.1, 1).normalized(), 0.2, 0.002}, b{{180, 120}, {1, 0}, 0.1, 0.001};
  const LineCorner corner = meet(a, b).value();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  const auto drawn = [&](Line line) {
    line.point += normal(random) * line.sigma_px * line.normal;
    line.normal = Eigen::Rotation2Dd(normal(random) * line.sigma_rad) * line.normal;
    return line;
  };
  for (int i = 0; i < 4000; ++i) {
    const Vector2d off = meet(drawn(a), drawn(b))->point - corner.point;
    spread += off * off.transpose() / 4000;
  }
  EXPECT_LT((spread - corner.covariance).norm(), 0.1 * spread.norm());
  EXPECT_FALSE(meet(a, a));
}

Line sideOf(const Quadrilateral& quad, int i) {
  const Vector2d along = (quad[(i + 1) % 4] - quad[i]).normalized();
  return {0.5 * (quad[i] + quad[(i + 1) % 4]), {along.y(), -along.x()}, 0.05, 0.001};
}

TEST(QuadMotion, PredictsAnUnseenSideFromThreeOrTwo) {
  for (int unseen : {0, 1, 2, 3})
    for (bool also_opposite : {false, true}) {
      QuadMotion motion;
      const auto at = [](int frame) {  // drifts and comes nearer
        const double half = 60.0 + 2.0 * frame, x = 150.0 + 1.5 * frame;
        return test::rectangle(x - half, 120 - half, x + half, 120 + half);
      };
      motion.start(at(0), 0.3);
      for (int i = 1; i < 40; ++i) {
        motion.predict(Eigen::Matrix3d::Identity(), 0.033, {2.0, 1.0, 0.2});
        for (int side = 0; side < 4; ++side)
          if (i < 10 || (side != unseen && !(also_opposite && side == (unseen + 2) % 4)))
            motion.correct(side, sideOf(at(i), side));
        motion.settle(0.033);
      }
      EXPECT_LT(test::worstCorner(motion.quad(), at(39)), also_opposite ? 8.0 : 4.0) << unseen;
      EXPECT_GT(motion.sigmaAcross(unseen), 2.0 * motion.sigmaAcross((unseen + 1) % 4));
    }
}

TEST(QuadMotion, ATurnOfTheCameraNeedsNoVelocity) {
  const auto camera = geometry::PinholeCamera::fromFieldOfView(320, 240, 1.2);
  const Quadrilateral quad = test::rectangle(100, 80, 200, 160);
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(0.05, Eigen::Vector3d(0.3, 1, 0.1).normalized()).toRotationMatrix();
  QuadMotion motion;
  motion.start(quad, 0.3);
  motion.predict(camera.K() * R * camera.K().inverse(), 0.033, {1, 1, 1});
  for (int i = 0; i < 4; ++i)
    EXPECT_LT((motion.quad()[i] - *camera.project(R * camera.ray(quad[i]))).norm(), 1e-6);
}

TEST(TrackMemory, TheSameOnlyInItsPlaceAndForAWhile) {
  const TrackParams params;
  TrackMemory memory(params);
  EXPECT_FALSE(memory.remembers(0.0));
  memory.found(false, 1.0);
  EXPECT_EQ(memory.id(), 1u);
  EXPECT_TRUE(memory.remembers(1.0 + 0.9 * params.reacquire_sec));
  EXPECT_FALSE(memory.remembers(1.0 + 1.1 * params.reacquire_sec));
  const Quadrilateral here = test::rectangle(100, 80, 200, 180);
  EXPECT_TRUE(memory.isSame(test::rectangle(120, 80, 220, 180), here));
  EXPECT_FALSE(memory.isSame(test::rectangle(160, 80, 260, 180), here)) << "beside";
  EXPECT_FALSE(memory.isSame(test::grown(here, 30), here)) << "larger";
  memory.found(true, 1.5);
  EXPECT_EQ(memory.id(), 1u);
  memory.found(false, 9.0);
  EXPECT_EQ(memory.id(), 2u);
}

}  // namespace window_ingress::detection::following_parts_test
