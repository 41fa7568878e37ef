#pragma once

#include <functional>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/parameters/key_list.hpp"
#include "window_ingress/text/input_error.hpp"

namespace YAML {
class Node;
}

namespace window_ingress::parameters {

/// A yaml file that cannot be used: `what()` has a line for each fault, "file:line: key: what is wrong".
class YamlError : public InputError {
 public:
  explicit YamlError(const std::string& what, int line = 0) : InputError(what), line(line) {}
  int line;  ///< of the file
};

/// Visitor that fills a parameter struct from one yaml mapping. Missing keys keep their defaults; unknown
/// keys, wrong types and values out of range are collected, with file, line and key.
class YamlReader {
 public:
  /// \param known all paths that may stand in the file, to say which may have been meant
  YamlReader(const std::string& file, const YAML::Node& mapping, std::vector<std::string> known = {});
  /// Of a mapping of one key.
  YamlReader(const std::string& file, const std::string& key, const YAML::Node& value);
  ~YamlReader();
  YamlReader(const YamlReader&) = delete;
  YamlReader& operator=(const YamlReader&) = delete;

  void operator()(const std::string& name, double& value, double minimum, double maximum);
  void operator()(const std::string& name, int& value, double minimum, double maximum);
  void operator()(const std::string& name, bool& value);
  void operator()(const std::string& name, std::string& value);
  void operator()(const std::string& name, std::vector<double>& value);  ///< a list of finite numbers
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& allowed);
  template <typename Params>
  void group(const std::string& name, Params& params) {
    if (auto child = descend(name)) {
      Params::visit(params, *child);
      child->refuseUnknownKeys();
    }
  }
  /// Keys that no field has asked for are faults.
  void refuseUnknownKeys();
  /// \throws YamlError that names every fault so far, those of groups included
  void throwIfFaulty() const;
  /// Paths of all that has been read, by this reader and those of its groups.
  const std::set<std::string>& said() const;

 private:
  struct Impl;
  explicit YamlReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<YamlReader> descend(const std::string& name);
  std::unique_ptr<Impl> impl_;
};

/// Visits a yaml file. \return paths of what it says \throws YamlError
std::set<std::string> visitYamlFile(const std::string& file, std::vector<std::string> known,
                                    const std::function<void(YamlReader&)>& visit);

/// Fills `params` from a yaml file. \return paths of what it says: "group/field" \throws YamlError
template <typename Params>
std::set<std::string> readYamlFile(const std::string& file, Params& params) {
  return visitYamlFile(file, keysOf(params), [&](YamlReader& reader) { Params::visit(params, reader); });
}

}  // namespace window_ingress::parameters
