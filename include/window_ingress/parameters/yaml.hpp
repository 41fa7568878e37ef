#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "window_ingress/parameters/fields.hpp"

namespace YAML {
class Node;
}

namespace window_ingress::parameters {

/// A yaml file that cannot be used: `what()` is one line "file:line: key: what is wrong".
class YamlError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Visitor that fills a parameter struct from one yaml mapping. Missing keys keep their defaults; unknown keys, wrong
/// types and values out of range are errors that name file, line and key.
class YamlReader {
 public:
  YamlReader(const std::string& file, const YAML::Node& mapping);
  ~YamlReader();
  YamlReader(const YamlReader&) = delete;
  YamlReader& operator=(const YamlReader&) = delete;

  void operator()(const std::string& name, double& value, double minimum, double maximum);
  void operator()(const std::string& name, int& value, double minimum, double maximum);
  void operator()(const std::string& name, bool& value);
  void operator()(const std::string& name, std::string& value);
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& allowed);
  template <typename Params>
  void group(const std::string& name, Params& params) {
    if (auto child = descend(name)) {
      Params::visit(params, *child);
      child->refuseUnknownKeys();
    }
  }
  /// \throws YamlError for the first key that no field has asked for.
  void refuseUnknownKeys() const;

 private:
  struct Impl;
  std::unique_ptr<YamlReader> descend(const std::string& name);
  std::unique_ptr<Impl> impl_;
};

/// Visits the mapping `section` of a yaml file, at its top or below the name of a node ("window_detector: {detector: ..}"),
/// or the whole file if `section` is empty; false, and nothing visited, if the file has no such section.
/// \throws YamlError
bool visitYamlFile(const std::string& file, const std::string& section,
                   const std::function<void(YamlReader&)>& visit);

/// Fills `params` from a section of a yaml file; see `visitYamlFile`.
template <typename Params>
bool readYamlFile(const std::string& file, const std::string& section, Params& params) {
  return visitYamlFile(file, section, [&](YamlReader& reader) { Params::visit(params, reader); });
}

}  // namespace window_ingress::parameters
