#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "refusal.hpp"
#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::parameters::field_list_test {

using detection::DetectorParams;

std::string errorOf(const std::string& assignment) {
  DetectorParams params;
  return test::refusalOf<std::invalid_argument>([&] { assign(fieldsOf(params), assignment); });
}

TEST(FieldList, SetsAndGetsTheStructItself) {
  DetectorParams params;
  const auto fields = fieldsOf(params);
  assign(fields, "edges/floor=7.5");
  assign(fields, "preprocess/equalise=true");
  assign(fields, "max_candidates=12");
  EXPECT_DOUBLE_EQ(params.edges.floor, 7.5);
  EXPECT_TRUE(params.preprocess.equalise);
  EXPECT_EQ(params.max_candidates, 12);
  params.edges.floor = 8.0;
  EXPECT_DOUBLE_EQ(find(fields, "edges/floor")->get(), 8.0);
  EXPECT_EQ(find(fields, "edges/flor"), nullptr);
}

TEST(FieldList, KeepsWithinTheRange) {
  DetectorParams params;
  const auto fields = fieldsOf(params);
  for (const Field& field : fields) {
    const double before = field.get();
    field.set(std::nan(""));
    EXPECT_EQ(field.get(), before) << field.name;
    for (const double wanted : {-1e300, 1e300, std::numeric_limits<double>::infinity()}) {
      field.set(wanted);
      EXPECT_GE(field.get(), field.minimum) << field.name;
      EXPECT_LE(field.get(), field.maximum) << field.name;
    }
  }
  EXPECT_TRUE(outOfRange(params).empty());
}

TEST(FieldList, RequiresAllValuesInRange) {
  DetectorParams params;
  EXPECT_EQ(requireInRange(params, "detector").max_candidates, params.max_candidates);
  params.max_candidates = -1;
  params.edges.floor = -1.0;
  const auto refusal = test::refusalOf<std::invalid_argument>([&] { requireInRange(params, "detector"); });
  EXPECT_EQ(refusal, "detector: " + joined(outOfRange(params)));
  EXPECT_TRUE(test::says(refusal, "detector: edges/floor = -1"));
  EXPECT_TRUE(test::says(refusal, "; max_candidates = -1 is not within"));
}

TEST(FieldList, RefusesWhatItDoesNotKnowByName) {
  EXPECT_EQ(errorOf("edges/flor=1"), "edges/flor: unknown name; did you mean 'floor'?");
  EXPECT_TRUE(test::says(errorOf("edges/floor"), "NAME=VALUE"));
  EXPECT_EQ(errorOf("edges/floor=much"), "edges/floor: 'much' is not a number");
  EXPECT_TRUE(test::says(errorOf("edges/floor="), "not a number"));
  EXPECT_TRUE(test::says(errorOf("edges/floor=nan"), "not a number"));
  EXPECT_TRUE(test::says(errorOf("edges/floor=1e9"), "is not within"));
  EXPECT_TRUE(test::says(errorOf(""), "NAME=VALUE"));
}

TEST(FieldList, TextsAreReadByRosAsWhatTheyAre) {
  DetectorParams params;
  const auto fields = fieldsOf(params);
  params.edges.floor = 6.0;
  EXPECT_EQ(toText(*find(fields, "edges/floor")), "6.0");
  params.edges.floor = 1e-5;
  EXPECT_EQ(toText(*find(fields, "edges/floor")), "1.0e-05");
  params.edges.floor = 0.1;
  EXPECT_EQ(toText(*find(fields, "edges/floor")), "0.1");
  EXPECT_EQ(toText(*find(fields, "max_candidates")), "40");
  EXPECT_EQ(toText(*find(fields, "preprocess/equalise")), "false");
}

TEST(FieldList, NothingChangedIsAnEmptyMapping) {
  DetectorParams params, same;
  EXPECT_TRUE(changed(fieldsOf(params), fieldsOf(same)).empty());
  EXPECT_EQ(toYaml({}, "window_detector/detector"), "window_detector:\n  detector: {}\n");
}

// Every value that is set is read back from the file.
TEST(FieldList, YamlReadsBackTheSame) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const test::TemporaryFolder folder;
  for (int i = 0; i < 50; ++i) {
    DetectorParams params, defaults;
    const auto fields = fieldsOf(params);
    for (const Field& field : fields)
      if (uniform(random) < 0.3) field.set(field.minimum + uniform(random) * (field.maximum - field.minimum));
    const auto different = changed(fields, fieldsOf(defaults));
    const std::string file = folder.write("overlay.yaml", toYaml(different, "window_detector/detector"));
    DetectorParams read = configuration::readOverlay(file).window_detector.detector;
    for (const Field& field : fieldsOf(read))
      EXPECT_EQ(field.get(), find(fields, field.name)->get()) << field.name;
  }
}

}  // namespace window_ingress::parameters::field_list_test
