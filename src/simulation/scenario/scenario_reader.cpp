#include "simulation/scenario/scenario_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "simulation/random_stream.hpp"
#include "simulation/scenario/scenario.hpp"
#include "simulation/scenario/vehicle_profiles.hpp"
#include "window_ingress/parameters/key_list.hpp"
#include "window_ingress/parameters/yaml.hpp"
#include "window_ingress/parameters/yaml_mapping.hpp"

namespace window_ingress::simulation {

using parameters::YamlError;
using parameters::YamlMapping;
using parameters::YamlReader;

struct ScenarioReader::Impl {
  YamlMapping mapping;
  std::uint32_t seed;
  Draws& draws;

  std::optional<double> quantileOf(const std::string& path) const {
    const auto given = draws.quantiles.find(path);
    if (given != draws.quantiles.end()) draws.used.insert(path);
    return given == draws.quantiles.end() ? std::nullopt : std::optional(std::clamp(given->second, 0.0, 1.0));
  }

  // What may stand there: the items of `{one_of: [...]}`, or the value itself.
  std::vector<YAML::Node> optionsOf(const std::string& name, const YAML::Node& node) const {
    if (!node.IsMap() || node.size() != 1 || !node["one_of"].IsDefined()) return {node};
    const YAML::Node items = node["one_of"];
    if (!items.IsSequence() || items.size() == 0)
      mapping.fail(node, name + ": one_of must be a list of at least one value");
    return {items.begin(), items.end()};
  }

  std::size_t drawOption(const std::string& name, std::size_t count) const {
    const double size = static_cast<double>(count);
    if (const auto quantile = quantileOf(mapping.path() + name))
      return static_cast<std::size_t>(std::min(*quantile * size, size - 1.0));
    return static_cast<std::size_t>(
        RandomStream(seed, mapping.path() + name + " option").uniformInt(0, static_cast<int>(count) - 1));
  }

  // Each option with true for the drawn one; none where the key is missing.
  std::vector<std::pair<YAML::Node, bool>> findOptions(const std::string& name) {
    const YAML::Node node = mapping.find(name);
    std::vector<std::pair<YAML::Node, bool>> found;
    if (!node.IsDefined()) return found;
    const auto options = optionsOf(name, node);
    const std::size_t drawn = drawOption(name, options.size());
    for (std::size_t i = 0; i < options.size(); ++i) found.emplace_back(options[i], i == drawn);
    return found;
  }

  // All options are read, so that a bad one is an error whatever the seed.
  template <typename Value, typename Read>
  void readDrawn(const std::string& name, Value& value, const Read& read) {
    const Value before = value;
    for (const auto& [node, drawn] : findOptions(name)) {
      Value candidate = before;
      read(node, candidate);
      if (drawn) value = candidate;
    }
  }

  // One value through the reader of all parameter files, for the same checks and words.
  template <typename Value, typename... Limits>
  void readOne(const std::string& name, const YAML::Node& node, Value& value, Limits... limits) const {
    YamlReader reader(mapping.file(), name, node);
    reader(name, value, limits...);
  }

  template <typename Number>
  std::pair<Number, Number> readRange(const std::string& name, const YAML::Node& node, double minimum,
                                      double maximum) const {
    if (node.size() != 2) mapping.fail(node, name + ": a range must have two ends, [min, max]");
    std::pair<Number, Number> range{};
    readOne(name, node[0], range.first, minimum, maximum);
    readOne(name, node[1], range.second, minimum, maximum);
    if (range.first > range.second)
      mapping.fail(node, name + ": the range's first end is the greater one; swap them");
    return range;
  }

  double draw(const std::string& path, std::pair<double, double> range) const {
    if (const auto quantile = quantileOf(path)) return range.first + *quantile * (range.second - range.first);
    return RandomStream(seed, path).uniform(range.first, range.second);
  }
  int draw(const std::string& path, std::pair<int, int> range) const {
    if (const auto quantile = quantileOf(path))
      return std::min(range.second,
                      range.first + static_cast<int>(*quantile * (range.second - range.first + 1)));
    return RandomStream(seed, path).uniformInt(range.first, range.second);
  }

  template <typename Number>
  void readNumber(const std::string& name, Number& value, double minimum, double maximum) {
    readDrawn(name, value, [&](const YAML::Node& node, Number& number) {
      if (!node.IsSequence()) return readOne(name, node, number, minimum, maximum);
      number = draw(mapping.path() + name, readRange<Number>(name, node, minimum, maximum));
    });
  }
};

ScenarioReader::ScenarioReader(const std::string& file, const YAML::Node& mapping, const std::string& path,
                               std::uint32_t seed, Draws& draws)
    : impl_(new Impl{YamlMapping(file, mapping, path), seed, draws}) {}

ScenarioReader::~ScenarioReader() = default;

void ScenarioReader::operator()(const std::string& name, double& value, double minimum, double maximum) {
  impl_->readNumber(name, value, minimum, maximum);
}

void ScenarioReader::operator()(const std::string& name, int& value, double minimum, double maximum) {
  impl_->readNumber(name, value, minimum, maximum);
}

void ScenarioReader::operator()(const std::string& name, bool& value) {
  impl_->readDrawn(name, value,
                   [&](const YAML::Node& node, bool& flag) { impl_->readOne(name, node, flag); });
}

void ScenarioReader::operator()(const std::string& name, std::string& value) {
  impl_->readDrawn(name, value,
                   [&](const YAML::Node& node, std::string& text) { impl_->readOne(name, node, text); });
}

void ScenarioReader::choice(const std::string& name, std::string& value,
                            const std::vector<std::string>& allowed) {
  impl_->readDrawn(name, value, [&](const YAML::Node& node, std::string& word) {
    YamlReader(impl_->mapping.file(), name, node).choice(name, word, allowed);
  });
}

std::vector<ScenarioReader::MappingOption> ScenarioReader::descend(const std::string& name) {
  std::vector<MappingOption> options;
  const std::string path = impl_->mapping.path() + name + "/";
  for (const auto& [node, drawn] : impl_->findOptions(name))
    options.push_back(
        {std::make_unique<ScenarioReader>(impl_->mapping.file(), node, path, impl_->seed, impl_->draws),
         drawn});
  return options;
}

std::vector<ScenarioReader::ListOption> ScenarioReader::descendAll(const std::string& name) {
  std::vector<ListOption> options;
  for (const auto& [node, drawn] : impl_->findOptions(name)) {
    if (!node.IsSequence()) impl_->mapping.fail(node, name + ": must be a list, or [] for none");
    ListOption& option = options.emplace_back();
    option.drawn = drawn;
    for (std::size_t i = 0; i < node.size(); ++i) {
      const std::string path = impl_->mapping.path() + name + "[" + std::to_string(i) + "]/";
      option.readers.push_back(
          std::make_unique<ScenarioReader>(impl_->mapping.file(), node[i], path, impl_->seed, impl_->draws));
    }
  }
  return options;
}

void ScenarioReader::refuseUnknownKeys() const {
  impl_->mapping.refuseUnknownKeys([this](const std::string& path) {
    return parameters::didYouMean(path, impl_->mapping.asked()) + "; see doc/scenarios.md";
  });
}

namespace {

YAML::Node spelledOut(const YAML::Node& vehicle) {
  if (!vehicle.IsScalar()) return vehicle;
  YAML::Node mapping(YAML::NodeType::Map);
  mapping["profile"] = vehicle;
  return mapping;
}

// `vehicle: NAME` is short for `vehicle: {profile: NAME}`, among the items of `{one_of: [...]}` too.
void spellOutProfile(YAML::Node& root) {
  if (!root.IsMap() || !root["vehicle"].IsDefined()) return;
  const YAML::Node vehicle = root["vehicle"];
  if (vehicle.IsScalar()) root["vehicle"] = spelledOut(vehicle);
  if (!vehicle.IsMap() || !vehicle["one_of"].IsDefined() || !vehicle["one_of"].IsSequence()) return;
  YAML::Node items(YAML::NodeType::Sequence);
  for (const auto& item : vehicle["one_of"]) items.push_back(spelledOut(item));
  root["vehicle"]["one_of"] = items;
}

// Twice: what the file leaves open follows from the profile, which stands in the file.
Scenario readScenario(const std::string& file, std::uint32_t seed, const Quantiles& quantiles) {
  YAML::Node root = parameters::loadYaml(file);
  spellOutProfile(root);
  Draws draws{quantiles};
  Scenario scenario, with_profile;
  ScenarioReader(file, root, "", seed, draws).fill(scenario);
  applyProfile(scenario.vehicle.profile, with_profile.vehicle, with_profile.odometry);
  ScenarioReader(file, root, "", seed, draws).fill(with_profile);
  for (const auto& [key, quantile] : quantiles)
    if (draws.used.count(key) == 0) throw ScenarioError(file + ": " + key + ": has no range to draw from");
  return with_profile;
}

}  // namespace

Scenario loadScenario(const std::string& file, std::uint32_t seed, const Quantiles& quantiles) {
  Scenario scenario;
  try {
    scenario = readScenario(file, seed, quantiles);
  } catch (const YamlError& error) {
    throw ScenarioError(error.what());
  }
  auto& calibration_file = scenario.camera.calibration_file;
  if (!calibration_file.empty())
    calibration_file = (std::filesystem::path(file).parent_path() / calibration_file).string();
  const auto faults = faultsOf(scenario);
  if (!faults.empty()) throw ScenarioError(file + ": " + parameters::joined(faults));
  return scenario;
}

}  // namespace window_ingress::simulation
