#include "openness/interior/edge_klt.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace window_ingress::openness::edge_klt_test {

/// A soft, slanted edge, bright to the right.
cv::Mat edgeAt(float x, float lean) {
  cv::Mat image(60, 80, CV_8UC1);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      const float from = static_cast<float>(u) - x - lean * static_cast<float>(v - 30);
      image.at<unsigned char>(v, u) =
          cv::saturate_cast<unsigned char>(100.0f + 40.0f * std::tanh(0.7f * from));
    }
  return image;
}

TEST(EdgeKlt, findsTheSteepestPlaces) {
  SlopeImage slopes;
  slopes.take(edgeAt(40.0f, 0.0f));
  const auto edges = slopes.steepest({5, 5, 70, 50}, 10, 5.0, 100);
  ASSERT_EQ(edges.size(), 5u);
  for (const EdgePoint& edge : edges) {
    EXPECT_NEAR(edge.place.x, 40.0f, 1.0f);
    EXPECT_NEAR(edge.normal.x, 1.0f, 1e-3f);
    EXPECT_NEAR(edge.normal.y, 0.0f, 1e-3f);
  }
  EXPECT_EQ(slopes.steepest({5, 5, 70, 50}, 10, 5.0, 2).size(), 2u);
  EXPECT_TRUE(slopes.steepest({5, 5, 70, 50}, 10, 200.0, 100).empty());
}

TEST(EdgeKlt, followsAcrossToATenthOfAPixel) {
  for (const float lean : {-0.3f, 0.0f, 0.4f})
    for (float moved = -3.0f; moved <= 3.0f; moved += 0.37f) {
      const cv::Mat key = edgeAt(40.0f, lean), now = edgeAt(40.0f + moved, lean);
      const float length = std::hypot(1.0f, lean);
      const EdgePoint edge{{40.0f, 30.0f}, {1.0f / length, -lean / length}};
      const auto found = followAcross(key, now, edge, edge.place);
      ASSERT_TRUE(found) << lean << " " << moved;
      EXPECT_NEAR((*found - edge.place).dot(edge.normal), moved / length, 0.1f) << lean << " " << moved;
    }
}

TEST(EdgeKlt, refusesWhatIsNotTheEdge) {
  const cv::Mat key = edgeAt(40.0f, 0.0f), none(60, 80, CV_8UC1, cv::Scalar(100));
  const EdgePoint edge{{40.0f, 30.0f}, {1.0f, 0.0f}};
  EXPECT_FALSE(followAcross(key, none, edge, edge.place)) << "gone";
  EXPECT_FALSE(followAcross(none, key, edge, edge.place)) << "never was";
  EXPECT_FALSE(followAcross(key, 255 - key, edge, edge.place)) << "dark where it was bright";
  EXPECT_FALSE(followAcross(key, key, {{1.0f, 30.0f}, {1.0f, 0.0f}}, {1.0f, 30.0f})) << "at the border";
  EXPECT_FALSE(followAcross(key, key, edge, {std::nanf(""), 30.0f}));
  EXPECT_FALSE(followAcross(key, edgeAt(60.0f, 0.0f), edge, edge.place)) << "too far away";
}

}  // namespace window_ingress::openness::edge_klt_test
