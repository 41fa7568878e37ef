#include "window_ingress/parameters/yaml.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "window_ingress/parameters/yaml_mapping.hpp"

namespace window_ingress::parameters {

namespace {

bool isFinite(double value) { return std::isfinite(value); }

}  // namespace

struct YamlReader::Impl {
  /// What the readers of one file share.
  struct File {
    std::vector<std::string> known;
    std::set<std::string> said;
  };

  YamlMapping mapping;
  std::shared_ptr<File> shared;

  template <typename Value>
  bool read(const std::string& name, Value& value, const char* expected) {
    const YAML::Node node = mapping.find(name);
    if (!node.IsDefined()) return false;
    try {
      value = node.as<Value>();
    } catch (const YAML::Exception&) {
      fail(name, std::string(": must be ") + expected);
    }
    shared->said.insert(mapping.path() + name);
    return true;
  }

  [[noreturn]] void fail(const std::string& name, const std::string& text) {
    mapping.fail(mapping.find(name), mapping.path() + name + text);
  }

  void refuse(const std::string& name, const RangeCheck& check) {
    if (!check.faults().empty()) mapping.fail(mapping.find(name), mapping.path() + check.faults().front());
  }

  template <typename Number>
  void readNumber(const std::string& name, Number& value, double minimum, double maximum,
                  const char* expected) {
    Number number = value;
    if (!read(name, number, expected)) return;
    RangeCheck check;
    check(name, number, minimum, maximum);
    refuse(name, check);
    value = number;
  }
};

YamlReader::YamlReader(const std::string& file, const YAML::Node& mapping, std::vector<std::string> known)
    : impl_(new Impl{YamlMapping(file, mapping),
                     std::make_shared<Impl::File>(Impl::File{std::move(known), {}})}) {}

YamlReader::YamlReader(const std::string& file, const std::string& key, const YAML::Node& value)
    : impl_(new Impl{YamlMapping(file, key, value), std::make_shared<Impl::File>()}) {}

YamlReader::YamlReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

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

void YamlReader::operator()(const std::string& name, std::vector<double>& value) {
  std::vector<double> numbers;
  if (!impl_->read(name, numbers, "a list of numbers")) return;
  if (!std::all_of(numbers.begin(), numbers.end(), isFinite)) impl_->fail(name, ": must be finite numbers");
  value = numbers;
}

void YamlReader::choice(const std::string& name, std::string& value,
                        const std::vector<std::string>& allowed) {
  std::string word = value;
  if (!impl_->read(name, word, "a text")) return;
  RangeCheck check;
  check.choice(name, word, allowed);
  impl_->refuse(name, check);
  value = word;
}

std::unique_ptr<YamlReader> YamlReader::descend(const std::string& name) {
  const YAML::Node node = impl_->mapping.find(name);
  if (!node.IsDefined()) return nullptr;
  const std::string path = impl_->mapping.path() + name;
  if (!node.IsMap()) impl_->fail(name, ": must be a mapping of keys to values");
  auto child =
      std::make_unique<Impl>(Impl{YamlMapping(impl_->mapping.file(), node, path + "/"), impl_->shared});
  return std::unique_ptr<YamlReader>(new YamlReader(std::move(child)));
}

void YamlReader::refuseUnknownKeys() const {
  impl_->mapping.refuseUnknownKeys(
      [&](const std::string& path) { return didYouMean(path, impl_->shared->known); });
}

const std::set<std::string>& YamlReader::said() const { return impl_->shared->said; }

std::set<std::string> visitYamlFile(const std::string& file, std::vector<std::string> known,
                                    const std::function<void(YamlReader&)>& visit) {
  YamlReader reader(file, loadYaml(file), std::move(known));
  visit(reader);
  reader.refuseUnknownKeys();
  return reader.said();
}

}  // namespace window_ingress::parameters
