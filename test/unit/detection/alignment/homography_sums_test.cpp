#include "detection/alignment/homography_sums.hpp"

#include <gtest/gtest.h>

#include <random>

namespace window_ingress::detection::homography_sums_test {

TEST(HomographySums, AreWhatTheDerivativesAddUpTo) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-0.7F, 0.7F);
  NormalSum normal;
  DerivativeSum sum;
  Matrix8f expected_normal = Matrix8f::Zero();
  Vector8f expected_sum = Vector8f::Zero();
  for (int i = 0; i < 50; ++i) {
    const float x = uniform(random), y = uniform(random), a = uniform(random), b = uniform(random),
                weight = 1.0F + uniform(random);
    // The same point twice, each with half of the weight.
    const Monomials m[2] = {monomialsOf(x, y), monomialsOf(x, y)};
    const float wa = 0.5F * weight * a, wb = 0.5F * weight * b, half_a[2] = {wa, wa}, half_b[2] = {wb, wb};
    const float aa[2] = {wa * a, wa * a}, ab[2] = {wa * b, wa * b}, bb[2] = {wb * b, wb * b};
    normal.add(m[0].data(), aa, ab, bb, 2);
    sum.add(m[0].data(), half_a, half_b, 2);
    Vector8f J;  // Jacobian of the slope (a, b) at (x, y)
    J << a * x, a * y, a, b * x, b * y, b, -(a * x + b * y) * x, -(a * x + b * y) * y;
    expected_normal += weight * J * J.transpose();
    expected_sum += weight * J;
  }
  EXPECT_TRUE(normal.matrix().isApprox(expected_normal, 1e-4F));
  EXPECT_TRUE(sum.vector().isApprox(expected_sum, 1e-4F));
}

}  // namespace window_ingress::detection::homography_sums_test
