#include "detection/alignment/ring_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "patched_wall.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection::ring_search_test {

using geometry::Quadrilateral;
using test::PatchedWall;
using test::seenFrom;

// Corner error of the nearest place, relative to the mean side.
double offBy(const std::vector<RingSearch::Place>& places, const Quadrilateral& opening) {
  double least = 10.0;
  for (const auto& place : places)
    least = std::min(least, test::worstCorner(place.quad, opening) / geometry::meanSide(opening));
  return least;
}

TEST(RingSearch, APlaceLeansAsTheViewDoes) {
  Quadrilateral corners, opening;
  RingSearch search;
  const PatchedWall wall(3, 0.07);
  const cv::Mat reference = wall.draw(seenFrom(2.5, 0.0), &corners);
  search.learn(reference, corners);
  for (const double yaw_rad : {-0.6, -0.4, 0.4, 0.6}) {
    const cv::Mat image = wall.draw(seenFrom(3.5, yaw_rad), &opening);
    const auto& places = search.run(image, 6);
    ASSERT_FALSE(places.empty());
    EXPECT_LT(offBy(places, opening), 0.06) << yaw_rad;
  }
}

}  // namespace window_ingress::detection::ring_search_test
