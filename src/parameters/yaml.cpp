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
    std::set<std::string> said = {};
    YamlFaults faults = {};
  };

  std::shared_ptr<File> shared;
  YamlMapping mapping;

  YamlError fault(const std::string& name, const std::string& text) {
    return mapping.fault(mapping.find(name), mapping.path() + text);
  }

  /// \param check of the value read, which is kept if this throws nothing
  template <typename Value, typename Check>
  void read(const std::string& name, Value& value, const char* expected, const Check& check) {
    const YAML::Node node = mapping.find(name);
    if (!node.IsDefined()) return;
    shared->faults.collect([&] {
      Value found{};
      try {
        found = node.as<Value>();
      } catch (const YAML::Exception&) {
        throw fault(name, name + ": must be " + expected);
      }
      check(found);
      value = found;
      shared->said.insert(mapping.path() + name);
    });
  }

  template <typename... Limits>
  auto within(const std::string& name, const Limits&... limits) {
    return [this, &name, &limits...](const auto& value) {
      RangeCheck check;
      check(name, value, limits...);
      if (!check.faults().empty()) throw fault(name, check.faults().front());
    };
  }
};

YamlReader::YamlReader(const std::string& file, const YAML::Node& mapping, std::vector<std::string> known) {
  const auto shared = std::make_shared<Impl::File>(Impl::File{std::move(known)});
  impl_.reset(new Impl{shared, YamlMapping(file, mapping, shared->faults)});
}

YamlReader::YamlReader(const std::string& file, const std::string& key, const YAML::Node& value)
    : impl_(new Impl{std::make_shared<Impl::File>(), YamlMapping(file, key, value)}) {}

YamlReader::YamlReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

YamlReader::~YamlReader() = default;

void YamlReader::operator()(const std::string& name, double& value, double minimum, double maximum) {
  impl_->read(name, value, "a number", impl_->within(name, minimum, maximum));
}

void YamlReader::operator()(const std::string& name, int& value, double minimum, double maximum) {
  impl_->read(name, value, "a whole number", impl_->within(name, minimum, maximum));
}

void YamlReader::operator()(const std::string& name, bool& value) {
  impl_->read(name, value, "true or false", impl_->within(name));
}

void YamlReader::operator()(const std::string& name, std::string& value) {
  impl_->read(name, value, "a text", impl_->within(name));
}

void YamlReader::operator()(const std::string& name, std::vector<double>& value) {
  impl_->read(name, value, "a list of numbers", [&](const std::vector<double>& numbers) {
    if (!std::all_of(numbers.begin(), numbers.end(), isFinite))
      throw impl_->fault(name, name + ": must be finite numbers");
  });
}

void YamlReader::choice(const std::string& name, std::string& value,
                        const std::vector<std::string>& allowed) {
  impl_->read(name, value, "a text", [&](const std::string& word) {
    RangeCheck check;
    check.choice(name, word, allowed);
    if (!check.faults().empty()) throw impl_->fault(name, check.faults().front());
  });
}

std::unique_ptr<YamlReader> YamlReader::descend(const std::string& name) {
  const YAML::Node node = impl_->mapping.find(name);
  std::unique_ptr<YamlReader> child;
  if (!node.IsDefined()) return child;
  impl_->shared->faults.collect([&] {
    const std::string& file = impl_->mapping.file();
    YamlMapping mapping(file, node, impl_->shared->faults, impl_->mapping.path() + name + "/");
    child.reset(new YamlReader(std::make_unique<Impl>(Impl{impl_->shared, std::move(mapping)})));
  });
  return child;
}

void YamlReader::refuseUnknownKeys() {
  impl_->mapping.refuseUnknownKeys(
      [&](const std::string& path) { return didYouMean(path, impl_->shared->known); }, impl_->shared->faults);
}

void YamlReader::throwIfFaulty() const { impl_->shared->faults.throwIfAny(); }

const std::set<std::string>& YamlReader::said() const { return impl_->shared->said; }

std::set<std::string> visitYamlFile(const std::string& file, std::vector<std::string> known,
                                    const std::function<void(YamlReader&)>& visit) {
  YamlReader reader(file, loadYaml(file), std::move(known));
  visit(reader);
  reader.refuseUnknownKeys();
  reader.throwIfFaulty();
  return reader.said();
}

}  // namespace window_ingress::parameters
