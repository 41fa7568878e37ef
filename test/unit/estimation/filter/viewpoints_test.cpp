#include "estimation/filter/viewpoints.hpp"

#include <gtest/gtest.h>

namespace window_ingress::estimation::viewpoints_test {

TEST(Viewpoints, CountsImagesByPlaceAlsoOnReturn) {
  Viewpoints viewpoints;
  const Eigen::Vector3d here(0, 0, 0), near(0.2, 0.2, 0), there(2, 0, 0);
  EXPECT_EQ(viewpoints.looksWith(here), 1.0);
  viewpoints.add(here);
  viewpoints.add(near);
  EXPECT_EQ(viewpoints.looksWith(here), 3.0);
  EXPECT_EQ(viewpoints.looksWith(there), 1.0);
  viewpoints.add(there);
  EXPECT_EQ(viewpoints.looksWith(there), 2.0);
  EXPECT_EQ(viewpoints.looksWith(near), 3.0);
  viewpoints.clear();
  EXPECT_EQ(viewpoints.looksWith(here), 1.0);
}

TEST(Viewpoints, ForgetsTheOldestOfVeryMany) {
  Viewpoints viewpoints;
  for (int i = 0; i < 1000; ++i) viewpoints.add({double(i), 0, 0});
  EXPECT_EQ(viewpoints.looksWith({0, 0, 0}), 1.0);
  EXPECT_EQ(viewpoints.looksWith({999, 0, 0}), 2.0);
}

}  // namespace window_ingress::estimation::viewpoints_test
