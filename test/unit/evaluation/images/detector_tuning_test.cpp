#include "evaluation/images/detector_tuning.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "drawn_window.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::evaluation::detector_tuning_test {

/// Small images of a window, and of walls.
std::vector<LabelledImage> images(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<LabelledImage> result;
  for (int i = 0; i < count; ++i) {
    const double left = 40.0 + random() % 60, top = 30.0 + random() % 40, width = 90.0 + random() % 50;
    test::DrawnWindow window;
    window.width = 320, window.height = 240;
    window.opening = {
        Eigen::Vector2d(left, top), {left + width, top}, {left + width, top + 100}, {left, top + 100}};
    window.frame_px = 9.0;
    window.seed = random();
    result.push_back({std::to_string(i), window.draw(), {window.opening}, std::nullopt});
  }
  return result;
}

detection::DetectorParams blinded() {
  detection::DetectorParams params;
  params.gates.min_area = 0.5;  // of the image
  return params;
}

TuningOptions options(int trials) {
  TuningOptions options;
  options.names = {"gates/min_area", "min_score", "preprocess/equalise", "max_candidates"};
  options.trials = trials;
  return options;
}

TEST(TuneDetector, UndoesABadSettingAndChangesNothingElse) {
  const auto set = images(4, 3);
  const detection::DetectorParams start = blinded();
  ASSERT_GT(countDetections(set, start, nullptr).missed, 0);
  int calls = 0;
  double last = 0.0;
  auto tuned = tuneDetector(set, start, nullptr, options(30), [&](int done, const DetectionCounts& best) {
    EXPECT_EQ(done, ++calls);
    EXPECT_GE(best.merit(), last) << "never worse than before";
    last = best.merit();
  });
  EXPECT_EQ(calls, 30);
  EXPECT_EQ(countDetections(set, tuned, nullptr).missed, 0);
  EXPECT_LT(tuned.gates.min_area, 0.2);
  detection::DetectorParams before = start;
  for (const auto& field : parameters::changed(parameters::fieldsOf(tuned), parameters::fieldsOf(before)))
    EXPECT_EQ(field.name, "gates/min_area") << "the others do nothing here";
  EXPECT_TRUE(parameters::outOfRange(tuned).empty());
}

TEST(TuneDetector, IsTheSameForTheSameSeed) {
  const auto set = images(2, 5);
  const auto run = [&](std::uint32_t seed) {
    TuningOptions o = options(12);
    o.seed = seed;
    auto tuned = tuneDetector(set, blinded(), nullptr, o, [](int, const DetectionCounts&) {});
    return parameters::toYaml(parameters::fieldsOf(tuned), "detector");
  };
  EXPECT_EQ(run(4), run(4));
}

TEST(TuneDetector, RefusesWhatItCannotDo) {
  const auto ignore = [](int, const DetectionCounts&) {};
  TuningOptions unknown = options(1);
  unknown.names = {"edges/flor"};
  EXPECT_THROW(tuneDetector(images(1, 1), {}, nullptr, unknown, ignore), std::invalid_argument);
  EXPECT_THROW(tuneDetector({}, {}, nullptr, options(1), ignore), std::invalid_argument);
  EXPECT_THROW(tuneDetector(images(1, 1), {}, nullptr, TuningOptions{}, ignore), std::invalid_argument);
}

TEST(TuneDetector, UsualFieldsAreFieldsOfTheDetector) {
  detection::DetectorParams params;
  const auto fields = parameters::fieldsOf(params);
  for (const std::string& name : usualFields()) EXPECT_NE(parameters::find(fields, name), nullptr) << name;
}

}  // namespace window_ingress::evaluation::detector_tuning_test
