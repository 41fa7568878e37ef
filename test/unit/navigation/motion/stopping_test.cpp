#include "navigation/motion/stopping.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace window_ingress::navigation::stopping_test {

TEST(StoppingSpeed, IsTheInverseOfTheStoppingDistance) {
  const VehicleParams vehicle;
  for (double speed = 0.05; speed < 3.0; speed += 0.1)
    EXPECT_NEAR(stoppingSpeed(stoppingDistance(speed, vehicle), vehicle), speed, 1e-12);
  for (const double nowhere_m : {0.0, -1.0, std::nan("")}) EXPECT_EQ(stoppingSpeed(nowhere_m, vehicle), 0.0);
}

}  // namespace window_ingress::navigation::stopping_test
