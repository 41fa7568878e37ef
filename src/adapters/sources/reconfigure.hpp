/// Parameter structs and dynamic_reconfigure, by the same `visit` as everything else. The names of nested
/// fields are joined with '_': `edges/floor` is `edges_floor`.
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>

#include <algorithm>
#include <boost/thread/recursive_mutex.hpp>
#include <exception>
#include <functional>
#include <string>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::adapters {

/// Visitor that keeps the joined name of the field it is at.
class JoinedNames {
 protected:
  std::string joined(const std::string& name) const { return prefix_ + name; }
  template <typename Self, typename Params>
  void visitGroup(Self& self, const std::string& name, Params& params) {
    const std::string outer = prefix_;
    prefix_ += name + "_";
    std::remove_const_t<Params>::visit(params, self);
    prefix_ = outer;
  }

 private:
  std::string prefix_;
};

/// Writes a struct into a message.
class ConfigWriter : private JoinedNames {
 public:
  void operator()(const std::string& name, double value, double, double) {
    add(message.doubles, name, value);
  }
  void operator()(const std::string& name, int value, double, double) { add(message.ints, name, value); }
  void operator()(const std::string& name, bool value) { add(message.bools, name, value); }
  void operator()(const std::string& name, const std::string& value) { add(message.strs, name, value); }
  template <typename Params>
  void group(const std::string& name, const Params& params) {
    visitGroup(*this, name, params);
  }
  dynamic_reconfigure::Config message;

 private:
  template <typename List, typename Value>
  void add(List& list, const std::string& name, const Value& value) {
    list.emplace_back();
    list.back().name = joined(name);
    list.back().value = value;
  }
};

/// Reads a struct from a message; what the message does not hold keeps its value.
class ConfigReader : private JoinedNames {
 public:
  explicit ConfigReader(const dynamic_reconfigure::Config& message) : message_(message) {}
  void operator()(const std::string& name, double& value, double, double) {
    find(message_.doubles, name, value);
  }
  void operator()(const std::string& name, int& value, double, double) { find(message_.ints, name, value); }
  void operator()(const std::string& name, bool& value) { find(message_.bools, name, value); }
  void operator()(const std::string& name, std::string& value) { find(message_.strs, name, value); }
  template <typename Params>
  void group(const std::string& name, Params& params) {
    visitGroup(*this, name, params);
  }

 private:
  template <typename List, typename Value>
  void find(const List& list, const std::string& name, Value& value) const {
    const std::string wanted = joined(name);
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.name == wanted; });
    if (found != list.end()) value = static_cast<Value>(found->value);
  }
  const dynamic_reconfigure::Config& message_;
};

template <typename Params>
dynamic_reconfigure::Config toConfigMsg(const Params& params) {
  ConfigWriter writer;
  Params::visit(params, writer);
  return writer.message;
}

template <typename Params>
Params fromConfigMsg(const dynamic_reconfigure::Config& message, Params params) {
  ConfigReader reader(message);
  Params::visit(params, reader);
  return params;
}

/// A generated configuration that is not cut to its ranges before anybody sees it: what is out of range is
/// then refused, and said, by whoever has to live by it.
template <typename Config>
struct Unclamped : Config {
  Unclamped() = default;
  Unclamped(const Config& config) : Config(config) {}
  void __clamp__() const {}
};

/// Serves `Params` below the private name `tuning`. A change is taken whole or not at all.
template <typename Config, typename Params>
class Reconfigure {
 public:
  /// \param apply is given each new struct; if it throws, the old one stays
  Reconfigure(const ros::NodeHandle& pnh, const Params& initial, std::function<void(const Params&)> apply)
      : params_(initial), apply_(std::move(apply)), server_(mutex_, ros::NodeHandle(pnh, "tuning")) {
    server_.updateConfig(toConfig(params_, Config::__getDefault__()));
    server_.setCallback([this](Unclamped<Config>& config, std::uint32_t) { change(config); });
  }

  static Config toConfig(const Params& params, Config config) {
    dynamic_reconfigure::Config message = toConfigMsg(params);
    config.__fromMessage__(message);
    return config;
  }

 private:
  void change(Config& config) {
    dynamic_reconfigure::Config message;
    config.__toMessage__(message);
    const Params wanted = fromConfigMsg(message, params_);
    try {
      apply_(wanted);
      params_ = wanted;
    } catch (const std::exception& error) {
      ROS_WARN("change refused, old values kept: %s", error.what());
      config = toConfig(params_, config);
    }
  }

  Params params_;
  std::function<void(const Params&)> apply_;
  boost::recursive_mutex mutex_;
  dynamic_reconfigure::Server<Unclamped<Config>> server_;
};

}  // namespace window_ingress::adapters
