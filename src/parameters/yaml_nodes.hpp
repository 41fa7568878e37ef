/// Shared by the readers of yaml files. Not installed, because it exposes yaml-cpp.
#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <string>
#include <vector>

#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::parameters {

/// \throws InputError if the file cannot be read or is not yaml
YAML::Node loadYaml(const std::string& file);

/// A fault at one place of a file: thrown while the place is read, then collected.
struct YamlFault {
  int line;
  std::string text;  ///< "file:line: key: what is wrong"
};
YamlFault faultAt(const std::string& file, const YAML::Node& at, const std::string& text);

/// All faults of one file, to be reported together.
class YamlFaults {
 public:
  void add(const YamlFault& fault) { by_line_.emplace(fault.line, fault.text); }
  /// Runs one step of reading and keeps the `YamlFault` that it throws.
  template <typename Step>
  void collect(const Step& step) {
    try {
      step();
    } catch (const YamlFault& fault) {
      add(fault);
    }
  }
  void throwIfAny() const;  ///< \throws InputError with one line per fault, in the order of the file

 private:
  std::multimap<int, std::string> by_line_;
};

/// A key of a mapping and its value.
struct YamlEntry {
  std::string name;
  YAML::Node key, value;
};
/// The entries of a mapping, in order. A node that is not a mapping, keys that are not words, and duplicate
/// keys are faults.
/// \param path of the mapping, with a '/' at its end; empty for the whole file
std::vector<YamlEntry> entriesOf(const std::string& file, const YAML::Node& mapping, const std::string& path,
                                 YamlFaults& faults);

/// Sets the field, whose name is its path in the file. \throws YamlFault if the value is not allowed
void readValue(const std::string& file, const YAML::Node& node, const Field& field);

}  // namespace window_ingress::parameters
