/// What every reader of yaml files shares. Private to the readers: it shows yaml-cpp.
#pragma once

#include <yaml-cpp/yaml.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace window_ingress::parameters {

/// One mapping of a yaml file, that knows which of its keys were asked for. Errors are `YamlError`s with file
/// and line.
class YamlMapping {
 public:
  /// \param path of the mapping in the file, with a '/' at its end; empty for the whole file
  YamlMapping(std::string file, const YAML::Node& mapping, std::string path = "");
  /// A mapping of one key. Not made as a node: yaml-cpp would merge the value's whole file into it.
  YamlMapping(std::string file, std::string key, const YAML::Node& value);

  const std::string& file() const { return file_; }
  const std::string& path() const { return path_; }

  /// The value of a key, not defined if there is none; the key is known from now on.
  YAML::Node find(const std::string& name);
  [[noreturn]] void fail(const YAML::Node& at, const std::string& text) const;
  /// The paths of all keys that were asked for.
  std::vector<std::string> asked() const;
  /// \throws YamlError for the first key that nobody has asked for. \param advice what to put behind, by its
  /// path
  void refuseUnknownKeys(const std::function<std::string(const std::string&)>& advice) const;

 private:
  std::string file_;
  YAML::Node mapping_;
  std::string path_, only_key_;  ///< whose value `mapping_` is, in a mapping of one key
  std::set<std::string> asked_;
};

/// \throws YamlError if the file cannot be read or is no yaml
YAML::Node loadYaml(const std::string& file);

}  // namespace window_ingress::parameters
