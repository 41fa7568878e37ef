/// What every reader of yaml files shares. Private to the readers: it shows yaml-cpp.
#pragma once

#include <yaml-cpp/yaml.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "window_ingress/parameters/yaml.hpp"

namespace window_ingress::parameters {

/// All that is wrong with one file, to be told at once.
class YamlFaults {
 public:
  void add(const YamlError& fault) { by_line_.emplace(fault.line, fault.what()); }
  /// Runs a step of reading, and keeps what it throws.
  template <typename Step>
  void collect(const Step& step) {
    try {
      step();
    } catch (const YamlError& fault) {
      add(fault);
    }
  }
  void throwIfAny() const;  ///< \throws YamlError with a line each, in the order of the file

 private:
  std::multimap<int, std::string> by_line_;
};

/// One mapping of a yaml file, that knows which of its keys were asked for. Errors are `YamlError`s with file
/// and line.
class YamlMapping {
 public:
  /// \param faults gets keys that are none or stand there twice
  /// \param path of the mapping in the file, with a '/' at its end; empty for the whole file
  YamlMapping(std::string file, const YAML::Node& mapping, YamlFaults& faults, std::string path = "");
  /// A mapping of one key. Not made as a node: yaml-cpp would merge the value's whole file into it.
  YamlMapping(std::string file, std::string key, const YAML::Node& value);

  const std::string& file() const { return file_; }
  const std::string& path() const { return path_; }

  /// The value of a key, not defined if there is none; the key is known from now on.
  YAML::Node find(const std::string& name);
  YamlError fault(const YAML::Node& at, const std::string& text) const;
  /// The paths of all keys that were asked for.
  std::vector<std::string> asked() const;
  /// Keys that nobody has asked for are faults. \param advice what to put behind, by the key's path
  void refuseUnknownKeys(const std::function<std::string(const std::string&)>& advice,
                         YamlFaults& faults) const;

 private:
  std::string file_;
  YAML::Node mapping_;
  std::string path_, only_key_;  ///< whose value `mapping_` is, in a mapping of one key
  std::set<std::string> asked_;
};

/// \throws YamlError if the file cannot be read or is no yaml
YAML::Node loadYaml(const std::string& file);

}  // namespace window_ingress::parameters
