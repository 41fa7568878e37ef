#include "detection/reference/reference_borders.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "drawn_window.hpp"

namespace window_ingress::detection::reference_borders_test {

using geometry::Quadrilateral;

/// A coloured frame in a wall, dark inside. `reveal_px` adds a strip of the reveal inside on the left.
struct Facade {
  Quadrilateral opening = test::rectangle(220, 140, 420, 320);
  double frame_px = 14.0;
  cv::Scalar paint = cv::Scalar(20, 95, 225);
  double reveal_px = 0.0;

  cv::Mat draw() const {
    cv::Mat image(480, 640, CV_8UC3, cv::Scalar(170, 180, 185));
    if (frame_px > 0.0) test::fillQuad(image, test::grown(opening, frame_px), paint);
    test::fillQuad(image, opening, cv::Scalar(120, 120, 120));
    Quadrilateral dark = opening;
    dark[0].x() += reveal_px, dark[3].x() += reveal_px;
    test::fillQuad(image, dark, cv::Scalar(40, 45, 40));
    cv::GaussianBlur(image, image, cv::Size(), 0.7);
    test::addNoise(image, 1.5, 5);
    return image;
  }
};

ReferenceBorders learned(const Facade& facade) {
  ReferenceBorders borders;
  borders.learn(facade.draw(), facade.opening);
  return borders;
}

void expectLocated(ReferenceBorders& borders, const Facade& facade, const Quadrilateral& rough) {
  const auto found = borders.locate(facade.draw(), rough, nullptr, ReferenceBorders::kFine);
  ASSERT_TRUE(found);
  EXPECT_LT(test::worstCorner(found->quad, facade.opening), 3.5);
  EXPECT_GT(found->border_score, 0.3);
}

TEST(ReferenceBorders, TheInnerBorderIsFoundFromTheOuterOneAndFromWithin) {
  const Facade facade;
  ReferenceBorders borders = learned(facade);
  ASSERT_TRUE(borders.known());
  for (double grown : {-12.0, -5.0, 0.0, 6.0, 14.0})
    expectLocated(borders, facade, test::grown(facade.opening, grown));
}

TEST(ReferenceBorders, TheFarEdgeOfTheRevealIsNotTheBorder) {
  Facade facade;
  ReferenceBorders borders = learned(facade);
  facade.reveal_px = 30.0;
  Quadrilateral rough = facade.opening;
  rough[0].x() += 30.0, rough[3].x() += 30.0;
  expectLocated(borders, facade, rough);
}

TEST(ReferenceBorders, ADifferentlyPaintedFrameIsWorthLittle) {
  ReferenceBorders borders = learned(Facade());
  Facade other;
  other.paint = cv::Scalar(200, 60, 30);
  const auto found = borders.locate(other.draw(), other.opening, nullptr, ReferenceBorders::kFine);
  EXPECT_LT(found ? found->border_score : 0.0, 0.2);
}

TEST(ReferenceBorders, AReferenceWithoutAFrameIsKnownAsSuch) {
  Facade hole;
  hole.frame_px = 0.0;
  EXPECT_TRUE(learned(hole).frameless());
  EXPECT_FALSE(learned(Facade()).frameless());
}

TEST(ReferenceBorders, NothingFromImagesWithoutColourOrWithoutSense) {
  const Facade facade;
  ReferenceBorders borders;
  cv::Mat grey;
  cv::cvtColor(facade.draw(), grey, cv::COLOR_BGR2GRAY);
  borders.learn(grey, facade.opening);
  EXPECT_FALSE(borders.known());
  EXPECT_FALSE(borders.locate(facade.draw(), facade.opening, nullptr, ReferenceBorders::kCoarse));
  borders.learn(cv::Mat(), facade.opening);
  EXPECT_FALSE(borders.known());
  borders = learned(facade);
  EXPECT_FALSE(borders.locate(grey, facade.opening, nullptr, ReferenceBorders::kCoarse));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(
      borders.locate(facade.draw(), test::rectangle(nan, 0, 5, 5), nullptr, ReferenceBorders::kCoarse));
  EXPECT_FALSE(
      borders.locate(facade.draw(), test::rectangle(7, 7, 7, 7), nullptr, ReferenceBorders::kCoarse));
  EXPECT_FALSE(borders.locate(facade.draw(), test::rectangle(-9e5, -9e5, -8e5, -8e5), nullptr,
                              ReferenceBorders::kCoarse));
}

}  // namespace window_ingress::detection::reference_borders_test
