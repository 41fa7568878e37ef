#include "window_ingress/geometry/median.hpp"

#include <gtest/gtest.h>

namespace window_ingress::geometry::median_test {

TEST(Median, IsTheMiddleValueAndTheUpperOneOfTwo) {
  std::vector<double> odd{5.0, -1.0, 2.0}, even{4.0, 1.0, 3.0, 2.0}, one{7.0};
  EXPECT_EQ(median(odd), 2.0);
  EXPECT_EQ(median(even), 3.0);
  EXPECT_EQ(median(one), 7.0);
}

TEST(Median, OfVectorsIsThatOfEachComponent) {
  std::vector<Eigen::Vector3d> values{{1, 9, -5}, {2, 8, 100}, {3, 7, -6}};
  EXPECT_EQ(componentwiseMedian(values), Eigen::Vector3d(2, 8, -5));
}

}  // namespace window_ingress::geometry::median_test
