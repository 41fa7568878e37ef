#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "simulation/scenario/scenario.hpp"

namespace YAML {
class Node;
}

namespace window_ingress::simulation {

/// Where within its range a key's value is to lie; and which of these keys there were.
struct Draws {
  const Quantiles& quantiles;
  std::set<std::string> used = {};
};

/// Visitor that fills a scenario from a yaml mapping. Beyond `parameters::YamlReader` it takes a range `[min,
/// max]` for any number, `{one_of: [...]}` for any value, and lists of structs. \throws parameters::YamlError
/// with file, line and key
class ScenarioReader {
 public:
  ScenarioReader(const std::string& file, const YAML::Node& mapping, const std::string& path,
                 std::uint32_t seed, Draws& draws);
  ~ScenarioReader();
  ScenarioReader(const ScenarioReader&) = delete;
  ScenarioReader& operator=(const ScenarioReader&) = delete;

  void operator()(const std::string& name, double& value, double minimum, double maximum);
  void operator()(const std::string& name, int& value, double minimum, double maximum);
  void operator()(const std::string& name, bool& value);
  void operator()(const std::string& name, std::string& value);
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& allowed);

  template <typename Params>
  void group(const std::string& name, Params& params) {
    const Params before = params;
    for (const auto& option : descend(name)) {
      Params candidate = before;
      option.reader->fill(candidate);
      if (option.drawn) params = candidate;
    }
  }
  template <typename Params>
  void list(const std::string& name, std::vector<Params>& items) {
    for (const auto& option : descendAll(name)) {
      std::vector<Params> candidates;
      for (const auto& reader : option.readers) reader->fill(candidates.emplace_back());
      if (option.drawn) items = candidates;
    }
  }
  template <typename Params>
  void fill(Params& params) {
    Params::visit(params, *this);
    refuseUnknownKeys();
  }

 private:
  struct Impl;
  // One of the options of a mapping or a list. All are read, so that a bad one is an error whatever the seed.
  struct MappingOption {
    std::unique_ptr<ScenarioReader> reader;
    bool drawn;
  };
  struct ListOption {
    std::vector<std::unique_ptr<ScenarioReader>> readers;
    bool drawn;
  };
  std::vector<MappingOption> descend(const std::string& name);
  std::vector<ListOption> descendAll(const std::string& name);
  void refuseUnknownKeys() const;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::simulation
