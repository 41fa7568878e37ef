#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace YAML {
class Node;
}

namespace window_ingress::simulation {

/// Visitor that fills a scenario from a yaml mapping. Beyond `parameters::YamlReader` it takes a range `[min,
/// max]` for any number, `{one_of: [...]}` for any value, and lists of structs. \throws parameters::YamlError with file, line and key
class ScenarioReader {
 public:
  ScenarioReader(const std::string& file, const YAML::Node& mapping, const std::string& path,
                 std::uint32_t seed);
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
    if (const auto child = descend(name)) child->fill(params);
  }
  template <typename Params>
  void list(const std::string& name, std::vector<Params>& items) {
    if (!has(name)) return;
    items.clear();
    for (const auto& child : descendAll(name)) child->fill(items.emplace_back());
  }
  template <typename Params>
  void fill(Params& params) {
    Params::visit(params, *this);
    refuseUnknownKeys();
  }

 private:
  struct Impl;
  bool has(const std::string& name) const;
  std::unique_ptr<ScenarioReader> descend(const std::string& name);
  std::vector<std::unique_ptr<ScenarioReader>> descendAll(const std::string& name);
  void refuseUnknownKeys() const;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::simulation
