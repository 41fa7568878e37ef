// The shipped yaml files and the schema of dynamic_reconfigure say the same as the structs.
#include <gtest/gtest.h>
#include <window_ingress/WindowDetectorConfig.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "adapters/images/detector_node.hpp"
#include "adapters/nodes/navigator_node.hpp"
#include "adapters/nodes/pose_node.hpp"
#include "adapters/nodes/setpoint_gate.hpp"
#include "adapters/world/world_node.hpp"

namespace window_ingress::adapters::parameter_files_test {

// Visitor that compares each field with a yaml mapping, and counts.
class YamlComparison {
 public:
  YamlComparison(const YAML::Node& mapping, const std::string& path) : mapping_(mapping), path_(path) {}
  template <typename Number>
  void operator()(const std::string& name, const Number& value, double, double) {
    const YAML::Node node = take(name);
    EXPECT_DOUBLE_EQ(node.as<double>(), value) << path_ << name;
  }
  void operator()(const std::string& name, bool value) {
    const YAML::Node node = take(name);
    EXPECT_EQ(node.as<bool>(), value) << path_ << name;
  }
  void operator()(const std::string& name, const std::string& value) {
    const YAML::Node node = take(name);
    EXPECT_EQ(node.as<std::string>(), value) << path_ << name;
  }
  void operator()(const std::string& name, const std::vector<double>& value) {
    const YAML::Node node = take(name);
    EXPECT_EQ(node.size(), value.size()) << path_ << name;
  }
  void choice(const std::string& name, const std::string& value, const std::vector<std::string>&) {
    (*this)(name, value);
  }
  template <typename Params>
  void group(const std::string& name, const Params& params) {
    YamlComparison child(take(name), path_ + name + "/");
    Params::visit(params, child);
    child.expectNoOthers();
  }
  void expectNoOthers() const {
    EXPECT_EQ(mapping_.size(), fields_) << path_ << " has keys that no field asks for";
  }

 private:
  YAML::Node take(const std::string& name) {
    ++fields_;
    const YAML::Node node = mapping_[name];
    EXPECT_TRUE(node.IsDefined()) << path_ << name << " is missing";
    return node.IsDefined() ? node : YAML::Node();
  }
  const YAML::Node mapping_;
  std::string path_;
  std::size_t fields_ = 0;
};

template <typename Params>
void expectSameAsFile(const std::string& name) {
  const std::string file = WINDOW_INGRESS_SOURCE_DIR "/config/" + name;
  YamlComparison comparison(YAML::LoadFile(file), name + ": ");
  const Params params;
  Params::visit(params, comparison);
  comparison.expectNoOthers();
}

TEST(ParameterFiles, YamlIsTheDefault) {
  expectSameAsFile<DetectorNodeParams>("detector.yaml");
  expectSameAsFile<PoseNodeParams>("pose.yaml");
  expectSameAsFile<NavigatorNodeParams>("navigator.yaml");
  expectSameAsFile<GuardParams>("guard.yaml");
  expectSameAsFile<WorldNodeParams>("world.yaml");
  expectSameAsFile<navigation::VehicleParams>("vehicle.yaml");
}

TEST(ParameterFiles, DefaultsAreInRange) {
  EXPECT_EQ(parameters::joined(parameters::outOfRange(DetectorNodeParams())), "");
  EXPECT_EQ(parameters::joined(parameters::outOfRange(PoseNodeParams())), "");
  EXPECT_EQ(parameters::joined(parameters::outOfRange(NavigatorNodeParams())), "");
  EXPECT_EQ(parameters::joined(parameters::outOfRange(GuardParams())), "");
  EXPECT_EQ(parameters::joined(parameters::outOfRange(WorldNodeParams())), "");
}

TEST(ParameterFiles, AreWrittenFromTheStructs) {
  EXPECT_EQ(
      std::system("/usr/bin/python3 " WINDOW_INGRESS_SOURCE_DIR "/dev/write_parameter_files.py --check"), 0);
}

using Config = window_ingress::WindowDetectorConfig;

std::map<std::string, double> numbers(const dynamic_reconfigure::Config& message) {
  std::map<std::string, double> found;
  for (const auto& entry : message.doubles) found[entry.name] = entry.value;
  for (const auto& entry : message.ints) found[entry.name] = entry.value;
  for (const auto& entry : message.bools) found[entry.name] = entry.value;
  return found;
}

dynamic_reconfigure::Config message(Config config) {
  dynamic_reconfigure::Config out;
  config.__toMessage__(out);
  return out;
}

TEST(Reconfigure, SchemaHasTheDefaultsOfTheStruct) {
  EXPECT_EQ(numbers(message(Config::__getDefault__())), numbers(toConfigMsg(detection::DetectorParams())));
}

// Visitor that collects the ranges under the joined names.
class Ranges : private JoinedNames {
 public:
  template <typename Number>
  void operator()(const std::string& name, const Number&, double minimum, double maximum) {
    lowest[joined(name)] = minimum;
    highest[joined(name)] = maximum;
  }
  template <typename Value>
  void operator()(const std::string&, const Value&) {}
  template <typename Params>
  void group(const std::string& name, const Params& params) {
    visitGroup(*this, name, params);
  }
  std::map<std::string, double> lowest, highest;
};

TEST(Reconfigure, SchemaHasTheRangesOfTheStruct) {
  Ranges ranges;
  const detection::DetectorParams params;
  detection::DetectorParams::visit(params, ranges);
  ASSERT_GT(ranges.lowest.size(), 30u);
  const auto low = numbers(message(Config::__getMin__())), high = numbers(message(Config::__getMax__()));
  for (const auto& [name, value] : ranges.lowest) EXPECT_DOUBLE_EQ(low.at(name), value) << name;
  for (const auto& [name, value] : ranges.highest) EXPECT_DOUBLE_EQ(high.at(name), value) << name;
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

TEST(Reconfigure, DescriptionsHaveUnitAndRange) {
  for (const auto& parameter : Config::__getParamDescriptions__()) {
    const std::string& text = parameter->description;
    if (parameter->type == "bool") continue;
    EXPECT_NE(text.find(" .. "), std::string::npos) << parameter->name;
    if (parameter->type == "int") continue;
    EXPECT_NE(text.find('['), std::string::npos) << parameter->name << ": " << text;
    for (const auto& [suffix, unit] : {std::pair{"_px", "px"}, {"_rad", "[rad"}, {"_sec", "[s"}}) {
      const bool wanted = endsWith(parameter->name, suffix);
      EXPECT_TRUE(!wanted || text.find(unit) != std::string::npos) << parameter->name;
    }
  }
}

// Visitor that collects the names of the groups.
struct GroupNames {
  template <typename... Rest>
  void operator()(const std::string&, Rest&&...) {}
  template <typename Params>
  void group(const std::string& name, const Params&) {
    names.insert(name);
  }
  std::set<std::string> names;
};

TEST(Reconfigure, EveryStageHasAGroupWithItsParameters) {
  GroupNames stages;
  const detection::DetectorParams params;
  detection::DetectorParams::visit(params, stages);
  ASSERT_GT(stages.names.size(), 8u);
  std::set<std::string> found;
  for (const auto& group : Config::__getGroupDescriptions__()) {
    if (group->id == 0) continue;
    found.insert(group->name);
    EXPECT_FALSE(group->parameters.empty()) << group->name;
    for (const auto& parameter : group->parameters)
      EXPECT_EQ(parameter.name.rfind(group->name + "_", 0), 0u) << parameter.name;
  }
  EXPECT_EQ(found, stages.names);
}

TEST(Reconfigure, StructGoesThereAndBack) {
  detection::DetectorParams params;
  params.min_score = 0.123;
  params.preprocess.equalise = !params.preprocess.equalise;
  params.max_candidates = 9;
  const auto back = fromConfigMsg(toConfigMsg(params), detection::DetectorParams());
  EXPECT_EQ(back.min_score, 0.123);
  EXPECT_EQ(back.preprocess.equalise, params.preprocess.equalise);
  EXPECT_EQ(back.max_candidates, 9);
}

}  // namespace window_ingress::adapters::parameter_files_test
