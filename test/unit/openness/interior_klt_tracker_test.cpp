#include "window_ingress/openness/interior_klt_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/openness/openness_judge.hpp"
#include "window_ingress/openness/plane_parallax.hpp"

namespace window_ingress::openness::interior_klt_tracker_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;

const geometry::OpeningSize kOpening{1.2, 1.0}, kNeeded{0.6, 0.34};
const auto kCamera = geometry::PinholeCamera::fromFieldOfView(480, 360, 1.2);

/// Smooth blotches, some 0.1 m large.
double blotches(double y, double z) {
  return 110.0 +
         40.0 * std::sin(31.0 * y + 3.0 * std::sin(23.0 * z)) * std::sin(27.0 * z + 2.0 * std::sin(19.0 * y));
}

/// Brightness along a line of sight that crosses the border's plane at (y, z) with the slope (across, up).
using Look = std::function<double(double y, double z, double across, double up)>;

double room(double y, double z, double across, double up) {
  return blotches(0.4 * (y + 3.0 * across), 0.4 * (z + 3.0 * up));
}
double poster(double y, double z, double, double) { return blotches(y, z); }
double halfBoard(double y, double z, double across, double up) {
  return y > 0.0 ? 205.0 : room(y, z, across, up);
}
double plainRoomWithCupboard(double y, double z, double across, double up) {
  const double there_y = y + 3.0 * across, there_z = z + 3.0 * up;
  return std::abs(there_y) < 0.5 && there_z < 0.1 ? 60.0 : 120.0;
}
double plain(double, double, double, double) { return 120.0; }

Isometry3d cameraAt(double plane_m) {
  return geometry::makePose(geometry::R_optical_flu().transpose(), {-plane_m, 0.04 * plane_m, 0.1});
}

cv::Mat draw(const Isometry3d& T_window_camera, const Look& look) {
  cv::Mat image(kCamera.height, kCamera.width, CV_8UC3);
  cv::RNG noise(static_cast<std::uint64_t>(1e6 * -T_window_camera.translation().x()));
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      const Vector3d ray = T_window_camera.linear() * kCamera.ray({u, v});
      const Vector3d eye = T_window_camera.translation(), way = ray / ray.x();
      const double y = eye.y() - eye.x() * way.y(), z = eye.z() - eye.x() * way.z();
      const bool within = std::abs(y) < 0.5 * kOpening.width_m && std::abs(z) < 0.5 * kOpening.height_m;
      const double grey = within ? look(y, z, way.y(), way.z()) : 180.0;
      const auto value = cv::saturate_cast<unsigned char>(grey + noise.gaussian(1.5));
      image.at<cv::Vec3b>(v, u) = {value, value, value};
    }
  return image;
}

detection::WindowObservation windowFrom(const Isometry3d& T_window_camera, double stamp_sec) {
  detection::WindowObservation window;
  window.stamp_sec = stamp_sec;
  window.target_id = 1;
  window.corners = *geometry::projectOpening(kCamera, T_window_camera.inverse(), kOpening);
  window.corner_covariance.fill(0.04 * Eigen::Matrix2d::Identity());
  return window;
}

struct Flown {
  OpennessVerdict verdict;
  bool ever_open = false;
};

Flown fly(const Look& look, const InteriorKltParams& params = {}) {
  InteriorKltTracker follower(params);
  OpennessJudge judge({}, kNeeded);
  Flown flown;
  for (double plane_m = 4.5; plane_m > 1.7; plane_m -= 0.07) {
    const Isometry3d camera = cameraAt(plane_m);
    auto window = windowFrom(camera, 105.0 - plane_m);
    follower.follow(draw(camera, look), window);
    judge.see({window, kCamera, camera, Isometry3d::Identity(), kOpening});
    flown.verdict = judge.verdict();
    flown.ever_open |= flown.verdict.openness == Openness::kOpen;
  }
  return flown;
}

TEST(InteriorKltTracker, pointsOfAPosterStayInThePlane) {
  InteriorKltTracker follower{InteriorKltParams()};
  const Isometry3d key = cameraAt(3.0), now = cameraAt(2.8);
  auto first = windowFrom(key, 1.0), second = windowFrom(now, 1.1);
  follower.follow(draw(key, poster), first);
  EXPECT_TRUE(first.interior.empty()) << "the keyframe itself";
  follower.follow(draw(now, poster), second);
  ASSERT_GT(second.interior.points.size(), 15u);
  EXPECT_EQ(second.interior.key_stamp_sec, 1.0);
  const geometry::UnitSquare before(first.corners), after(second.corners);
  for (const auto& point : second.interior.points) {
    const Eigen::Vector2d expected = after.toImage(before.fromImage(point.key_px));
    const Eigen::Vector2d off = point.now_px - expected;
    EXPECT_LT(point.normal.isZero(0.0) ? off.norm() : std::abs(off.dot(point.normal)), 0.7);
  }
}

TEST(InteriorKltTracker, withTheJudgeTellsARoomFromAPoster) {
  EXPECT_EQ(fly(room).verdict.openness, Openness::kOpen) << fly(room).verdict.reason;
  EXPECT_NEAR(fly(room).verdict.depth_behind_m, 3.0, 0.7);
  EXPECT_EQ(fly(poster).verdict.openness, Openness::kClosed);
  EXPECT_FALSE(fly(poster).ever_open);
}

TEST(InteriorKltTracker, halfABoardIsNotOpen) {
  EXPECT_FALSE(fly(halfBoard).ever_open) << fly(halfBoard).verdict.reason;
}

TEST(InteriorKltTracker, bareWallIsAsDeepAsTheEdgesItEndsAt) {
  const auto flown = fly(plainRoomWithCupboard);
  EXPECT_EQ(flown.verdict.openness, Openness::kOpen) << flown.verdict.reason;
  InteriorKltParams params;
  params.surface_slope = 0.0;
  EXPECT_EQ(fly(plainRoomWithCupboard, params).verdict.openness, Openness::kUnknown)
      << "by the points alone most of it is unseen";
}

// Such a wall has no edges. So a plain board in front of it must be recognised by its own edges.
TEST(InteriorKltTracker, plainBoardBeforeABareRoomIsNotOpen) {
  for (const double contrast : {-20.0, 5.0, 60.0})
    for (const double edge_m : {-0.1, 0.0})
      for (int side = 0; side < 4; ++side) {
        const auto look = [&](double y, double z, double across, double up) {
          const double into[] = {y, -y, z, -z};
          return into[side] > edge_m ? 120.0 + contrast : plainRoomWithCupboard(y, z, across, up);
        };
        EXPECT_FALSE(fly(look).ever_open)
            << contrast << " grey levels, from " << edge_m << " m, side " << side;
      }
}

TEST(InteriorKltTracker, whatIsTooDarkToShowAnEdgeIsUnknown) {
  const auto dark = [](double y, double z, double across, double up) {
    return 0.1 * plainRoomWithCupboard(y, z, across, up);
  };
  EXPECT_EQ(fly(dark).verdict.openness, Openness::kUnknown) << fly(dark).verdict.reason;
}

TEST(InteriorKltTracker, nothingToFollowIsUnknown) {
  EXPECT_EQ(fly(plain).verdict.openness, Openness::kUnknown);
  EXPECT_EQ(fly(plain).verdict.log_odds, 0.0);
}

TEST(InteriorKltTracker, switchedOffOrWithBadInputItHandsOutNothing) {
  InteriorKltParams off;
  off.enabled = false;
  InteriorKltTracker idle(off), follower{InteriorKltParams()};
  const Isometry3d camera = cameraAt(3.0);
  const cv::Mat image = draw(camera, poster);
  for (int i = 0; i < 3; ++i) {
    auto window = windowFrom(camera, 1.0 + 0.1 * i);
    idle.follow(image, window);
    EXPECT_TRUE(window.interior.empty());
    window = windowFrom(camera, 1.0 + 0.1 * i);
    window.corners[2].x() = std::numeric_limits<double>::quiet_NaN();
    follower.follow(image, window);
    EXPECT_TRUE(window.interior.empty());
    window = windowFrom(camera, 1.0 + 0.1 * i);
    window.corner_visible[0] = false;
    follower.follow(image, window);
    EXPECT_TRUE(window.interior.empty());
    window = windowFrom(camera, 1.0 + 0.1 * i);
    follower.follow(cv::Mat(), window);
    EXPECT_TRUE(window.interior.empty());
  }
  auto far = windowFrom(camera, 2.0);
  for (auto& corner : far.corners) corner += Eigen::Vector2d(1e5, 1e5);
  EXPECT_NO_THROW(follower.follow(image, far)) << "outside the image";
  off.max_side_px = 7.0;
  EXPECT_THROW(InteriorKltTracker{off}, std::invalid_argument);
}

TEST(InteriorKltTracker, anotherTargetBeginsAnew) {
  InteriorKltTracker follower{InteriorKltParams()};
  const Isometry3d camera = cameraAt(3.0);
  const cv::Mat image = draw(camera, poster);
  auto window = windowFrom(camera, 1.0);
  follower.follow(image, window);
  window = windowFrom(camera, 1.1);
  follower.follow(image, window);
  EXPECT_FALSE(window.interior.empty());
  window = windowFrom(camera, 1.2);
  window.target_id = 2;
  follower.follow(image, window);
  EXPECT_TRUE(window.interior.empty());
  window = windowFrom(camera, 0.5);
  window.target_id = 2;
  follower.follow(image, window);
  EXPECT_TRUE(window.interior.empty()) << "time goes back";
}

}  // namespace window_ingress::openness::interior_klt_tracker_test
