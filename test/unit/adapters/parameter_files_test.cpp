// The shipped yaml files and the schema of dynamic_reconfigure agree with the structs.
#include <gtest/gtest.h>
#include <window_ingress/WindowDetectorConfig.h>
#include <yaml-cpp/yaml.h>

#include <cstdlib>
#include <map>
#include <set>

#include "adapters/runtime/reconfigure.hpp"
#include "window_ingress/configuration/overlay.hpp"

namespace window_ingress::adapters::parameter_files_test {

using namespace configuration;

using parameters::Field;

// The values of a file by the full names of their fields.
void list(const YAML::Node& node, const std::string& path, std::map<std::string, YAML::Node>& values) {
  if (!node.IsMap()) values[path] = node;
  if (node.IsMap())
    for (const auto& entry : node)
      list(entry.second, path + (path.empty() ? "" : "/") + entry.first.as<std::string>(), values);
}

template <typename Params>
void expectSameAsFile(const std::string& name) {
  const std::string file = WINDOW_INGRESS_SOURCE_DIR "/config/" + name;
  std::map<std::string, YAML::Node> values;
  list(YAML::LoadFile(file), "", values);
  Params params;
  for (const Field& field : parameters::fieldsOf(params)) {
    ASSERT_EQ(values.count(field.name), 1u) << name << ": " << field.name << " is missing";
    const YAML::Node value = values[field.name];
    std::visit(
        [&](auto* at) {
          EXPECT_EQ(value.as<std::decay_t<decltype(*at)>>(), *at) << name << ": " << field.name;
        },
        field.value);
    values.erase(field.name);
  }
  for (const auto& [key, value] : values) ADD_FAILURE() << name << ": no field asks for " << key;
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

TEST(Reconfigure, SchemaHasTheRangesOfTheStruct) {
  detection::DetectorParams params;
  const auto low = numbers(message(Config::__getMin__())), high = numbers(message(Config::__getMax__()));
  const auto fields = parameters::fieldsOf(params);
  ASSERT_GT(fields.size(), 30u);
  for (const Field& field : fields) {
    if (field.isSwitch()) continue;
    EXPECT_DOUBLE_EQ(low.at(joinedName(field.name)), field.minimum) << field.name;
    EXPECT_DOUBLE_EQ(high.at(joinedName(field.name)), field.maximum) << field.name;
  }
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

TEST(Reconfigure, EveryStageHasAGroupWithItsParameters) {
  detection::DetectorParams params;
  std::set<std::string> stages, found;
  for (const Field& field : parameters::fieldsOf(params))
    if (const auto end = field.name.find('/'); end != std::string::npos)
      stages.insert(field.name.substr(0, end));
  ASSERT_GT(stages.size(), 8u);
  for (const auto& group : Config::__getGroupDescriptions__()) {
    if (group->id == 0) continue;
    found.insert(group->name);
    EXPECT_FALSE(group->parameters.empty()) << group->name;
    for (const auto& parameter : group->parameters)
      EXPECT_EQ(parameter.name.rfind(group->name + "_", 0), 0u) << parameter.name;
  }
  EXPECT_EQ(found, stages);
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
