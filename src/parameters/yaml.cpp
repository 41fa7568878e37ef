#include "window_ingress/parameters/yaml.hpp"

#include <yaml-cpp/yaml.h>

#include "window_ingress/parameters/yaml_mapping.hpp"

namespace window_ingress::parameters {

struct YamlReader::Impl {
  YamlMapping mapping;

  template <typename Value>
  bool read(const std::string& name, Value& value, const char* expected) {
    const YAML::Node node = mapping.find(name);
    if (!node.IsDefined()) return false;
    try {
      value = node.as<Value>();
    } catch (const YAML::Exception&) {
      mapping.fail(node, name + ": must be " + expected);
    }
    return true;
  }

  template <typename Number>
  void readNumber(const std::string& name, Number& value, double minimum, double maximum,
                  const char* expected) {
    Number number = value;
    if (!read(name, number, expected)) return;
    RangeCheck check;
    check(name, number, minimum, maximum);
    if (!check.faults().empty()) mapping.fail(mapping.find(name), check.faults().front());
    value = number;
  }
};

YamlReader::YamlReader(const std::string& file, const YAML::Node& mapping)
    : impl_(new Impl{YamlMapping(file, mapping)}) {}

YamlReader::~YamlReader() = default;

void YamlReader::operator()(const std::string& name, double& value, double minimum, double maximum) {
  impl_->readNumber(name, value, minimum, maximum, "a number");
}

void YamlReader::operator()(const std::string& name, int& value, double minimum, double maximum) {
  impl_->readNumber(name, value, minimum, maximum, "a whole number");
}

void YamlReader::operator()(const std::string& name, bool& value) {
  impl_->read(name, value, "true or false");
}

void YamlReader::operator()(const std::string& name, std::string& value) {
  impl_->read(name, value, "a text");
}

void YamlReader::choice(const std::string& name, std::string& value,
                        const std::vector<std::string>& allowed) {
  std::string word = value;
  if (!impl_->read(name, word, "a text")) return;
  RangeCheck check;
  check.choice(name, word, allowed);
  if (!check.faults().empty()) impl_->mapping.fail(impl_->mapping.find(name), check.faults().front());
  value = word;
}

std::unique_ptr<YamlReader> YamlReader::descend(const std::string& name) {
  const YAML::Node node = impl_->mapping.find(name);
  if (!node.IsDefined()) return nullptr;
  return std::make_unique<YamlReader>(impl_->mapping.file(), node);
}

void YamlReader::refuseUnknownKeys() const { impl_->mapping.refuseUnknownKeys(); }

namespace {

// At the top of the file, or below the name of a node, as in the files that launch files lay over the
// defaults.
YAML::Node sectionOf(const YAML::Node& root, const std::string& section) {
  if (const YAML::Node found = root[section]; found.IsDefined()) return found;
  for (const auto& node : root) {
    if (!node.second.IsMap()) continue;
    const YAML::Node& below = node.second;
    if (const YAML::Node found = below[section]; found.IsDefined()) return found;
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

}  // namespace

bool visitYamlFile(const std::string& file, const std::string& section,
                   const std::function<void(YamlReader&)>& visit) {
  YAML::Node root = loadYaml(file);
  if (!section.empty()) {
    if (!root.IsMap()) throw YamlError(file + ":1: must be a mapping of keys to values");
    const YAML::Node found = sectionOf(root, section);
    if (!found.IsDefined()) return false;
    root.reset(found);
  }
  YamlReader reader(file, root);
  visit(reader);
  reader.refuseUnknownKeys();
  return true;
}

}  // namespace window_ingress::parameters
