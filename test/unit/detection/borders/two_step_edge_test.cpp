#include "detection/borders/two_step_edge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace window_ingress::detection::two_step_edge_test {

using Eigen::Vector3f;

constexpr int kHalf = 4, kSize = 2 * kHalf + 1;
const Vector3f kFrame(10, 40, 90), kReveal(70, 75, 75), kRoom(150, 165, 170);

struct Strip {
  double front = 0.0, apart = 0.0, blur = 0.8;
  Vector3f outside = kFrame, reveal = kReveal, within = kRoom;
};

// Mean colours across a blurred strip, by channel.
std::vector<float> across(const Strip& strip, int channels = 3, float noise = 0.0F, unsigned seed = 1) {
  std::mt19937 engine(seed);
  std::normal_distribution<float> draw(0.0F, noise > 0.0F ? noise : 1.0F);
  const auto step = [&](double z) {
    return static_cast<float>(0.5 * std::erfc(-z / strip.blur * M_SQRT1_2));
  };
  std::vector<float> mean;
  for (int c = 0; c < channels; ++c)
    for (int o = -kHalf; o <= kHalf; ++o) {
      const float front = step(o - strip.front), back = step(o - strip.front + strip.apart);
      mean.push_back(strip.within[c] + (strip.reveal[c] - strip.within[c]) * back +
                     (strip.outside[c] - strip.reveal[c]) * front + (noise > 0.0F ? draw(engine) : 0.0F));
    }
  return mean;
}

TwoStepEdge fitted(const Strip& strip, const TwoStepEdgeLimits& limits = {}, float noise = 0.0F,
                   unsigned seed = 1) {
  return fitTwoStepEdge(across(strip, 3, noise, seed).data(), 3, kHalf, limits);
}

TEST(TwoStepEdge, ASingleEdgeStaysWhereItIs) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    Strip strip;
    strip.front = 0.4 * std::sin(seed);
    strip.blur = 0.6 + 0.01 * seed;
    const TwoStepEdge edge = fitted(strip, {}, 0.25F, seed);
    EXPECT_EQ(edge.apart, 0.0) << seed;
    EXPECT_LT(edge.sigma_px, 0.2) << seed;
  }
}

TEST(TwoStepEdge, TheFrontOfAStripIsFoundToATenthOfAPixel) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> back(-0.7, 0.0), apart(0.5, 2.5);
  int unnoticed = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    Strip strip;
    strip.apart = apart(engine), strip.front = strip.apart + back(engine);
    const TwoStepEdge edge = fitted(strip, {-3.0, 3.0}, 0.2F, seed);
    if (edge.apart == 0.0) {
      ++unnoticed;
      continue;
    }
    // Only its colour reveals a strip that is thinner than the blur.
    const double limit_px = strip.apart > 1.2 ? 0.1 : strip.apart;
    EXPECT_NEAR(edge.front, strip.front, limit_px + 2.0 * edge.sigma_px) << strip.apart;
  }
  EXPECT_LE(unnoticed, 2);
}

TEST(TwoStepEdge, AThinBrightStripDoesNotMoveTheBorder) {
  Strip strip;
  strip.outside = {16, 78, 185}, strip.reveal = {183, 192, 198}, strip.within = {67, 75, 77};
  strip.apart = 0.4;
  const TwoStepEdge edge = fitted(strip, {}, 0.15F);
  ASSERT_GT(edge.apart, 0.0);
  EXPECT_NEAR(edge.front, 0.0, 0.1);
}

TEST(TwoStepEdge, AFrontBeyondTheLimitsIsNotTaken) {
  Strip reveal;
  reveal.front = 2.2, reveal.apart = 2.2;
  EXPECT_NEAR(fitted(reveal, {-3.0, 3.0}, 0.2F).front, 2.2, 0.15);
  EXPECT_LT(std::abs(fitted(reveal, {}, 0.2F).front), 1.2);
}

TEST(TwoStepEdge, ASharpenedEdgeIsOneEdge) {
  std::vector<float> mean = across({});
  for (int c = 0; c < 3; ++c) {
    const std::vector<float> soft(mean.begin() + c * kSize, mean.begin() + (c + 1) * kSize);
    for (int k = 1; k + 1 < kSize; ++k)
      mean[c * kSize + k] += 0.4F * (2.0F * soft[k] - soft[k - 1] - soft[k + 1]);
  }
  const TwoStepEdge edge = fitTwoStepEdge(mean.data(), 3, kHalf, {});
  EXPECT_LT(std::abs(edge.front), 0.15);
}

TEST(TwoStepEdge, GreyImagesAndBadNumbers) {
  Strip grey;
  grey.apart = 2.0;
  const auto one = across(grey, 1);
  const TwoStepEdge edge = fitTwoStepEdge(one.data(), 1, kHalf, {});
  EXPECT_LT(std::abs(edge.front), 0.3);
  const std::vector<float> flat(3 * kSize, 100.0F);
  EXPECT_EQ(fitTwoStepEdge(flat.data(), 3, kHalf, {}).apart, 0.0);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::vector<float> mean = across({});
    mean[5] = bad;
    const TwoStepEdge none = fitTwoStepEdge(mean.data(), 3, kHalf, {});
    EXPECT_EQ(none.apart, 0.0);
    EXPECT_TRUE(std::isfinite(none.front) && std::isfinite(none.sigma_px));
  }
}

}  // namespace window_ingress::detection::two_step_edge_test
