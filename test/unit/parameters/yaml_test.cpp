#include "window_ingress/parameters/yaml.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "refusal.hpp"

namespace window_ingress::parameters::yaml_test {

struct Inner {
  int count = 3;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("count", self.count, 0, 10);
  }
};

struct Sample {
  std::vector<double> corners;
  double speed_mps = 1.0;
  bool fast = false;
  std::string name = "plain";
  Inner inner;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("corners", self.corners);
    field("speed_mps", self.speed_mps, 0.0, 5.0);
    field("fast", self.fast);
    field("name", self.name);
    field.group("inner", self.inner);
  }
};

class YamlFile : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  const std::string file_ = folder_.path / "sample.yaml";
  std::set<std::string> said_;

  Sample read(const std::string& text) {
    folder_.write("sample.yaml", text);
    Sample sample;
    said_ = readYamlFile(file_, sample);
    return sample;
  }
  std::string error(const std::string& text) {
    return test::refusalOf([&] { read(text); });
  }
};

TEST_F(YamlFile, ReadsFieldsAndKeepsDefaults) {
  const Sample sample = read("speed_mps: 2.5\ninner: {count: 7}\nfast: true\n");
  EXPECT_DOUBLE_EQ(sample.speed_mps, 2.5);
  EXPECT_TRUE(sample.fast);
  EXPECT_EQ(sample.inner.count, 7);
  EXPECT_EQ(sample.name, "plain");
}

TEST_F(YamlFile, TellsWhatTheFileSays) {
  EXPECT_EQ(read("corners: [1, 2.5]\ninner: {count: 3}\n").corners, (std::vector<double>{1.0, 2.5}));
  EXPECT_EQ(said_, (std::set<std::string>{"corners", "inner/count"}));
}

TEST_F(YamlFile, NamesFileLineAndKeyOfEveryKindOfFault) {
  EXPECT_EQ(error("fast: true\nspeed_mps: 9\n"), file_ + ":2: speed_mps = 9 is not within 0 .. 5");
  EXPECT_EQ(error("fast: true\nspeed: 1\n"), file_ + ":2: speed: unknown key; did you mean 'speed_mps'?");
  EXPECT_EQ(error("inner:\n  cuont: 1\n"), file_ + ":2: inner/cuont: unknown key; did you mean 'count'?");
  EXPECT_EQ(error("count: 1\n"), file_ + ":1: count: unknown key; did you mean 'inner: {count: ..}'?");
  EXPECT_EQ(error("inner: 1\n"), file_ + ":1: inner: must be a mapping of keys to values, not '1'");
  EXPECT_EQ(error("corners: [1, .nan]\n"), file_ + ":1: corners: must be finite numbers");
  EXPECT_EQ(error("speed_mps: quick\n"), file_ + ":1: speed_mps: must be a number, not 'quick'");
  EXPECT_EQ(error("inner: {count: 1.5}\n"), file_ + ":1: inner/count: must be a whole number, not '1.5'");
  EXPECT_EQ(error("speed_mps: [1]\n"), file_ + ":1: speed_mps: must be a number, not a list");
  for (const char* text : {"fast: true\nspeed_mps:\n\nname: x\n", "fast: true\nspeed_mps: # quick\n"})
    EXPECT_EQ(error(text), file_ + ":2: speed_mps: is empty; give it a value, or leave it out");
  EXPECT_EQ(error("inner:\nfast: true\n"), file_ + ":1: inner: is empty; give it a value, or leave it out");
  EXPECT_EQ(error("inner: {count: 1,30}\n"),
            file_ + ":1: inner/30: is a number without a key: a comma in place of a decimal point?");
  EXPECT_TRUE(test::says(error("speed_mps: .nan\n"), "not within"));
  EXPECT_EQ(error("fast: true\nfast: false\n"), file_ + ":2: fast: is given twice");
  EXPECT_EQ(error("inner: {count: 1}\ninner/count: 2\n"), file_ + ":2: inner/count: is given twice");
  EXPECT_TRUE(test::says(error("a: [1, 2\n"), "not valid yaml"));
  EXPECT_FALSE(test::says(error("a: [1, 2\n"), "tabs"));
  EXPECT_TRUE(test::says(error("a:\n\tb: {c: 1}\n"), "yaml does not allow tabs"));
  EXPECT_TRUE(test::says(error("fast: true\n---\nfast: false\n"), "holds 2 documents"));
  EXPECT_TRUE(test::says(error("- 1\n"), "must be a mapping"));
  EXPECT_TRUE(test::says(error(std::string("\xff\xfe"
                                           "1\0\n\0",
                                           6)),
                         "save it as UTF-8"));
}

// Nodes read the same file through ROS, which treats these as texts, or reads "010" as eight.
TEST_F(YamlFile, RefusesWhatRosReadsOtherwise) {
  for (const char* value : {"\"0.5\"", "'1'", "1e-1", "1.0e1", "010", "+.5"})
    EXPECT_TRUE(test::says(error(std::string("speed_mps: ") + value + "\n"),
                           ":1: speed_mps: must be a number; ROS reads"))
        << value;
  EXPECT_TRUE(test::says(error("fast: y\n"), "must be true or false; ROS reads"));
  EXPECT_TRUE(test::says(error("corners: [1, \"2\"]\n"), "must be a list of numbers; ROS reads"));
  EXPECT_DOUBLE_EQ(read("speed_mps: 1.0e-1\nfast: False\nname: \"1e-1\"\ncorners: [0, 0.5, -1]\n").speed_mps,
                   0.1);
}

TEST_F(YamlFile, TellsAllFaultsAtOnceInTheOrderOfTheFile) {
  EXPECT_EQ(error("speeed_mps: 1\ninner: {count: 11, cuont: 1}\nfast: 7\ncorners: 1\nfast: true\n[a]: 1\n"),
            file_ + ":1: speeed_mps: unknown key; did you mean 'speed_mps'?\n" +   //
                file_ + ":2: inner/count = 11 is not within 0 .. 10\n" +           //
                file_ + ":2: inner/cuont: unknown key; did you mean 'count'?\n" +  //
                file_ + ":3: fast: must be true or false, not '7'\n" +             //
                file_ + ":4: corners: must be a list of numbers, not '1'\n" +      //
                file_ + ":5: fast: is given twice\n" +                             //
                file_ + ":6: a key must be a word");
}

TEST_F(YamlFile, MissingFileAndFolderSaySo) {
  for (const std::string file : {"/nowhere/params.yaml", "/"}) {
    Sample sample;
    EXPECT_TRUE(test::says(test::refusalOf([&] { readYamlFile(file, sample); }), file + ": cannot be read"));
  }
}

TEST(OutOfRange, ListsAllFaultsWithTheirPath) {
  Sample sample;
  sample.speed_mps = -1;
  sample.inner.count = 11;
  const auto faults = outOfRange(sample);
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[1], "inner/count = 11 is not within 0 .. 10");
  EXPECT_TRUE(outOfRange(Sample{}).empty());
}

}  // namespace window_ingress::parameters::yaml_test
