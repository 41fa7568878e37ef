#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "parameters/yaml_nodes.hpp"
#include "simulation/random_stream.hpp"
#include "simulation/scenario/scenario.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::simulation {

namespace {

/// Requested quantiles, those of them that were used, and faults.
struct Draws {
  const Quantiles& quantiles;
  std::set<std::string> used = {};
  parameters::YamlFaults faults = {};
};

/// Visitor that fills a scenario from a yaml mapping. In addition to parameter files it accepts a range
/// `[min, max]` for any number, `{one_of: [...]}` for any value, and lists of structs. Faults go to the
/// draws.
class ScenarioReader {
 public:
  ScenarioReader(const std::string& file, const YAML::Node& mapping, const std::string& path,
                 std::uint32_t seed, Draws& draws)
      : file_(file),
        path_(path),
        entries_(parameters::entriesOf(file, mapping, path, draws.faults)),
        seed_(seed),
        draws_(draws) {}

  template <typename Params>
  void fill(Params& params) {
    Params::visit(params, *this);
    for (const auto& entry : entries_)
      if (std::find(asked_.begin(), asked_.end(), path_ + entry.name) == asked_.end())
        draws_.faults.add(faultAt(entry.key, entry.name + ": unknown key" +
                                                 parameters::didYouMean(path_ + entry.name, asked_) +
                                                 "; see doc/scenarios.md"));
  }

  template <typename Number>
  void operator()(const std::string& name, Number& value, double minimum, double maximum) {
    readDrawn(name, value, [&](const YAML::Node& node, Number& number) {
      if (!node.IsSequence()) return readOne(node, {path_ + name, &number, minimum, maximum});
      number = draw(path_ + name, readRange<Number>(name, node, minimum, maximum));
    });
  }
  template <typename Value>
  void operator()(const std::string& name, Value& value) {
    readDrawn(name, value, [&](const YAML::Node& node, Value& one) { readOne(node, {path_ + name, &one}); });
  }
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& allowed) {
    readDrawn(name, value, [&](const YAML::Node& node, std::string& word) {
      readOne(node, {path_ + name, &word, 0.0, 1.0, allowed});
    });
  }
  template <typename Params>
  void group(const std::string& name, Params& params) {
    readDrawn(name, params, [&](const YAML::Node& node, Params& group) { below(name, node).fill(group); });
  }
  template <typename Params>
  void list(const std::string& name, std::vector<Params>& items) {
    readDrawn(name, items, [&](const YAML::Node& node, std::vector<Params>& listed) {
      if (!node.IsSequence()) throw faultAt(node, name + ": must be a list, or [] for none");
      listed.clear();
      for (std::size_t i = 0; i < node.size(); ++i)
        below(name + "[" + std::to_string(i) + "]", node[i]).fill(listed.emplace_back());
    });
  }

 private:
  ScenarioReader below(const std::string& name, const YAML::Node& node) const {
    return {file_, node, path_ + name + "/", seed_, draws_};
  }

  std::optional<double> quantileOf(const std::string& path) const {
    const auto given = draws_.quantiles.find(path);
    if (given == draws_.quantiles.end()) return std::nullopt;
    draws_.used.insert(path);
    return std::clamp(given->second, 0.0, 1.0);
  }

  // The possible values: the items of `{one_of: [...]}`, or the value itself.
  std::vector<YAML::Node> optionsOf(const std::string& name, const YAML::Node& node) const {
    if (!node.IsMap() || node.size() != 1 || !node["one_of"].IsDefined()) return {node};
    const YAML::Node items = node["one_of"];
    if (!items.IsSequence() || items.size() == 0)
      throw faultAt(node, name + ": one_of must be a list of at least one value");
    return {items.begin(), items.end()};
  }

  std::size_t drawOption(const std::string& name, std::size_t count) const {
    if (count == 1) return 0;
    const double size = static_cast<double>(count);
    if (const auto quantile = quantileOf(path_ + name))
      return static_cast<std::size_t>(std::min(*quantile * size, size - 1.0));
    return static_cast<std::size_t>(
        RandomStream(seed_, path_ + name + " option").uniformInt(0, static_cast<int>(count) - 1));
  }

  // Reads all options, so that a bad one is an error whatever the seed.
  template <typename Value, typename Read>
  void readDrawn(const std::string& name, Value& value, const Read& read) {
    asked_.push_back(path_ + name);
    const auto entry =
        std::find_if(entries_.begin(), entries_.end(), [&](const auto& one) { return one.name == name; });
    if (entry == entries_.end()) return;
    draws_.faults.collect([&] {
      const auto options = optionsOf(name, entry->value);
      const std::size_t drawn = drawOption(name, options.size());
      const Value before = value;
      for (std::size_t i = 0; i < options.size(); ++i) {
        Value candidate = before;
        read(options[i], candidate);
        if (i == drawn) value = candidate;
      }
    });
  }

  // Reads one value as in parameter files.
  void readOne(const YAML::Node& node, const parameters::Field& field) const {
    parameters::readValue(file_, node, field);
  }
  parameters::YamlFault faultAt(const YAML::Node& at, const std::string& text) const {
    return parameters::faultAt(file_, at, path_ + text);
  }

  template <typename Number>
  std::pair<Number, Number> readRange(const std::string& name, const YAML::Node& node, double minimum,
                                      double maximum) const {
    if (node.size() != 2) throw faultAt(node, name + ": a range must have two ends, [min, max]");
    std::pair<Number, Number> range{};
    readOne(node[0], {path_ + name, &range.first, minimum, maximum});
    readOne(node[1], {path_ + name, &range.second, minimum, maximum});
    if (range.first > range.second)
      throw faultAt(node, name + ": the range's first end is the greater one; swap them");
    return range;
  }

  double draw(const std::string& path, std::pair<double, double> range) const {
    if (const auto quantile = quantileOf(path)) return range.first + *quantile * (range.second - range.first);
    return RandomStream(seed_, path).uniform(range.first, range.second);
  }
  int draw(const std::string& path, std::pair<int, int> range) const {
    if (const auto quantile = quantileOf(path))
      return std::min(range.second,
                      range.first + static_cast<int>(*quantile * (range.second - range.first + 1)));
    return RandomStream(seed_, path).uniformInt(range.first, range.second);
  }

  const std::string& file_;
  std::string path_;
  std::vector<parameters::YamlEntry> entries_;
  std::vector<std::string> asked_;
  std::uint32_t seed_;
  Draws& draws_;
};

YAML::Node spelledOut(const YAML::Node& vehicle) {
  if (!vehicle.IsScalar()) return vehicle;
  YAML::Node mapping(YAML::NodeType::Map);
  mapping["profile"] = vehicle;
  return mapping;
}

// `vehicle: NAME` is short for `vehicle: {profile: NAME}`, also among the items of `{one_of: [...]}`.
void spellOutProfile(YAML::Node& root) {
  if (!root.IsMap() || !root["vehicle"].IsDefined()) return;
  const YAML::Node vehicle = root["vehicle"];
  if (vehicle.IsScalar()) root["vehicle"] = spelledOut(vehicle);
  if (!vehicle.IsMap() || !vehicle["one_of"].IsDefined() || !vehicle["one_of"].IsSequence()) return;
  YAML::Node items(YAML::NodeType::Sequence);
  for (const auto& item : vehicle["one_of"]) items.push_back(spelledOut(item));
  root["vehicle"]["one_of"] = items;
}

// Reads the file twice, because the defaults depend on the profile, which is in the file.
Scenario readScenario(const std::string& file, std::uint32_t seed, const Quantiles& quantiles) {
  YAML::Node root = parameters::loadYaml(file);
  spellOutProfile(root);
  Draws draws{quantiles};
  Scenario scenario, with_profile;
  ScenarioReader(file, root, "", seed, draws).fill(scenario);
  draws.faults.throwIfAny();
  applyProfile(scenario.vehicle.profile, with_profile.vehicle, with_profile.odometry);
  ScenarioReader(file, root, "", seed, draws).fill(with_profile);
  for (const auto& [key, quantile] : quantiles)
    if (draws.used.count(key) == 0) throw InputError(file + ": " + key + ": has no range to draw from");
  return with_profile;
}

}  // namespace

Scenario loadScenario(const std::string& file, std::uint32_t seed, const Quantiles& quantiles) {
  Scenario scenario = readScenario(file, seed, quantiles);
  auto& calibration_file = scenario.camera.calibration_file;
  if (!calibration_file.empty())
    calibration_file = (std::filesystem::path(file).parent_path() / calibration_file).string();
  const auto faults = faultsOf(scenario);
  if (!faults.empty()) throw InputError(file + ": " + parameters::joined(faults));
  return scenario;
}

}  // namespace window_ingress::simulation
