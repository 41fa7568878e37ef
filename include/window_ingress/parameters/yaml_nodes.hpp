/// What all who read yaml files share. Private to them: it shows yaml-cpp.
#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <string>
#include <vector>

#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::parameters {

/// \throws InputError if the file cannot be read or is no yaml
YAML::Node loadYaml(const std::string& file);

/// What is wrong at one place of a file: thrown while that is read, and collected.
struct YamlFault {
  int line;
  std::string text;  ///< "file:line: key: what is wrong"
};
YamlFault faultAt(const std::string& file, const YAML::Node& at, const std::string& text);

/// All that is wrong with one file, to be told at once.
class YamlFaults {
 public:
  void add(const YamlFault& fault) { by_line_.emplace(fault.line, fault.text); }
  /// Runs a step of reading, and keeps the `YamlFault` that it throws.
  template <typename Step>
  void collect(const Step& step) {
    try {
      step();
    } catch (const YamlFault& fault) {
      add(fault);
    }
  }
  void throwIfAny() const;  ///< \throws InputError with a line each, in the order of the file

 private:
  std::multimap<int, std::string> by_line_;
};

/// A key of a mapping, and what stands there.
struct YamlEntry {
  std::string name;
  YAML::Node key, value;
};
/// The entries of a mapping, in order. One that is none, keys that are no words, and keys that stand there
/// twice are faults. \param path of the mapping, with a '/' at its end; empty for the whole file
std::vector<YamlEntry> entriesOf(const std::string& file, const YAML::Node& mapping, const std::string& path,
                                 YamlFaults& faults);

/// Sets the field, whose name is its path in the file. \throws YamlFault if it cannot have such a value
void readValue(const std::string& file, const YAML::Node& node, const Field& field);

}  // namespace window_ingress::parameters
