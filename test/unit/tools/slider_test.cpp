#include "tools/slider.hpp"

#include <gtest/gtest.h>

#include "window_ingress/detection/detector_params.hpp"

namespace window_ingress::tools::slider_test {

template <typename Value>
Slider sliderOf(Value value, double minimum, double maximum) {
  return Slider({"field", &value, minimum, maximum});
}

TEST(Slider, SwitchesAndSmallWholeNumbersGoOneByOne) {
  EXPECT_EQ(sliderOf(true, 0.0, 1.0).positions(), 1);
  const Slider slider = sliderOf(2, 2.0, 300.0);
  EXPECT_EQ(slider.positions(), 298);
  for (int value = 2; value <= 300; ++value) EXPECT_EQ(slider.valueAt(slider.positionOf(value)), value);
}

TEST(Slider, WideRangesGoByTheLogarithm) {
  const Slider slider = sliderOf(0.1, 0.1, 1000.0);
  EXPECT_NEAR(slider.valueAt(Slider::kSteps / 2), 10.0, 1e-9);
  EXPECT_EQ(slider.valueAt(-5), 0.1);
  EXPECT_EQ(slider.valueAt(Slider::kSteps + 5), 1000.0);
}

// For every parameter: the slider reaches both ends, is monotonic, and keeps the default within one step.
TEST(Slider, FitsEveryParameterOfTheDetector) {
  detection::DetectorParams params;
  for (const parameters::Field& one : parameters::fieldsOf(params)) {
    const Slider slider(one);
    EXPECT_EQ(slider.positionOf(one.minimum), 0) << one.name;
    EXPECT_EQ(slider.positionOf(one.maximum), slider.positions()) << one.name;
    double before = one.minimum;
    for (int position = 0; position <= slider.positions(); ++position) {
      const double value = slider.valueAt(position);
      EXPECT_GE(value, before) << one.name;
      EXPECT_EQ(slider.positionOf(value), position) << one.name;
      before = value;
      if (one.isWhole() && slider.positions() == Slider::kSteps) break;  // steps may share a number
    }
  }
}

}  // namespace window_ingress::tools::slider_test
