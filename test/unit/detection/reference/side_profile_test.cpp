#include "detection/reference/side_profile.hpp"

#include <gtest/gtest.h>

#include "drawn_window.hpp"

namespace window_ingress::detection::side_profile_test {

SideProfile stepAt(double place) {
  SideProfile profile;
  profile.first = -0.1, profile.step = 0.01;
  for (int i = 0; i < 41; ++i)
    profile.means.push_back(Eigen::Vector3f::Constant(profile.at(i) < place ? 40.0F : 100.0F));
  return profile;
}

TEST(SideProfile, MeansAndTheLargestChange) {
  const SideProfile profile = stepAt(0.095);
  Eigen::Vector3f colour;
  ASSERT_TRUE(profile.mean(-0.05, 0.05, colour));
  EXPECT_FLOAT_EQ(colour[0], 40.0F);
  ASSERT_TRUE(profile.mean(0.1, 0.2, colour));
  EXPECT_FLOAT_EQ(colour[1], 100.0F);
  EXPECT_FALSE(profile.mean(0.2, 0.4, colour)) << "beyond its end";
  EXPECT_FALSE(profile.mean(-0.2, 0.0, colour)) << "before its beginning";
  double place = 0.0;
  EXPECT_NEAR(profile.largestChange(0.0, 0.2, &place), 60.0 * std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(place, 0.095, 0.011);
  EXPECT_EQ(profile.largestChange(0.15, 0.25), 0.0);
  EXPECT_EQ(profile.change(0), 0.0F);
  EXPECT_EQ(profile.change(1000), 0.0F);
  EXPECT_EQ(SideProfile().largestChange(0.0, 1.0), 0.0);
  EXPECT_FALSE(SideProfile().mean(0.0, 1.0, colour));
}

TEST(SideProfile, SidesAreMeasuredFromTheLoopOutwards) {
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(150));
  const auto opening = test::rectangle(220, 160, 420, 320);
  test::fillQuad(image, opening, cv::Scalar::all(30));
  std::array<SideProfile, 4> sides;
  measureSides(image, opening, nullptr, {0.1, 0.3, 200.0 / 160.0, 24, 140}, sides);
  for (const SideProfile& side : sides) {
    double place = 1.0;
    EXPECT_GT(side.largestChange(-0.09, 0.29, &place), 100.0);
    EXPECT_NEAR(place, 0.0, 0.01);
  }
}

TEST(SideProfile, EndsWithTheImage) {
  const cv::Mat image(200, 200, CV_8UC3, cv::Scalar::all(90));
  std::array<SideProfile, 4> sides;
  measureSides(image, test::rectangle(5, 60, 105, 160), nullptr, {0.1, 0.4, 1.0, 24, 140}, sides);
  EXPECT_LT(sides[geometry::kLeft].means.size(), sides[geometry::kRight].means.size());
  measureSides(image, test::rectangle(-900, -900, -800, -800), nullptr, {0.1, 0.4, 1.0, 24, 140}, sides);
  for (const SideProfile& side : sides) EXPECT_TRUE(side.means.empty());
}

}  // namespace window_ingress::detection::side_profile_test
