#include "window_ingress/parameters/yaml_mapping.hpp"

#include <algorithm>
#include <ios>
#include <utility>

namespace window_ingress::parameters {

void YamlFaults::throwIfAny() const {
  std::string lines;
  for (const auto& [line, fault] : by_line_) lines += (lines.empty() ? "" : "\n") + fault;
  if (!lines.empty()) throw YamlError(lines, by_line_.begin()->first);
}

YamlMapping::YamlMapping(std::string file, const YAML::Node& mapping, YamlFaults& faults, std::string path)
    : file_(std::move(file)), mapping_(mapping), path_(std::move(path)) {
  const std::string place = path_.empty() ? "" : path_.substr(0, path_.size() - 1) + ": ";
  if (!mapping.IsMap()) throw fault(mapping, place + "must be a mapping of keys to values");
  std::set<std::string> keys;
  for (const auto& entry : mapping) {
    if (!entry.first.IsScalar())
      faults.add(fault(entry.first, place + "a key must be a word"));
    else if (!keys.insert(entry.first.Scalar()).second)
      faults.add(fault(entry.first, path_ + entry.first.Scalar() + ": stands here for the second time"));
  }
}

YamlMapping::YamlMapping(std::string file, std::string key, const YAML::Node& value)
    : file_(std::move(file)), mapping_(value), only_key_(std::move(key)) {}

YAML::Node YamlMapping::find(const std::string& name) {
  if (!only_key_.empty()) return name == only_key_ ? mapping_ : YAML::Node(YAML::NodeType::Undefined);
  asked_.insert(name);
  return static_cast<const YAML::Node&>(mapping_)[name];
}

YamlError YamlMapping::fault(const YAML::Node& at, const std::string& text) const {
  const int line = std::max(0, at.Mark().line) + 1;
  return YamlError(file_ + ":" + std::to_string(line) + ": " + text, line);
}

std::vector<std::string> YamlMapping::asked() const {
  std::vector<std::string> paths;
  for (const auto& key : asked_) paths.push_back(path_ + key);
  return paths;
}

void YamlMapping::refuseUnknownKeys(const std::function<std::string(const std::string&)>& advice,
                                    YamlFaults& faults) const {
  for (const auto& entry : mapping_) {
    const std::string path = path_ + entry.first.Scalar();
    if (entry.first.IsScalar() && asked_.count(entry.first.Scalar()) == 0)
      faults.add(fault(entry.first, path + ": unknown key" + advice(path)));
  }
}

YAML::Node loadYaml(const std::string& file) {
  try {
    return YAML::LoadFile(file);
  } catch (const YAML::BadFile&) {
    throw YamlError(file + ": cannot be read; does it exist?");
  } catch (const std::ios_base::failure&) {
    throw YamlError(file + ": cannot be read; a folder?");
  } catch (const YAML::Exception& error) {
    throw YamlError(file + ":" + std::to_string(error.mark.line + 1) + ": not valid yaml: " + error.msg);
  }
}

}  // namespace window_ingress::parameters
