/// Parameter structs and dynamic_reconfigure, by the same `visit` as yaml and rosparam. Names of nested
/// fields are joined with '_': `edges/floor` becomes `edges_floor`.
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/config_tools.h>
#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>

#include <algorithm>
#include <boost/thread/recursive_mutex.hpp>
#include <exception>
#include <functional>
#include <string>
#include <type_traits>
#include <variant>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::adapters {

/// The name of a field in dynamic_reconfigure.
inline std::string joinedName(std::string name) {
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

/// Calls `each(name in dynamic_reconfigure, value)` for the numbers and switches of a struct.
template <typename Params, typename Each>
void forEachNumber(Params& params, const Each& each) {
  const auto visit = [&each](const std::string& name, auto& value) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) each(name, value);
  };
  for (const parameters::Field& field : parameters::fieldsOf(params))
    std::visit([&](auto* value) { visit(joinedName(field.name), *value); }, field.value);
}

/// The numbers and switches of a struct as a message.
template <typename Params>
dynamic_reconfigure::Config toConfigMsg(Params params) {
  dynamic_reconfigure::Config message;
  forEachNumber(params, [&](const std::string& name, const auto& value) {
    dynamic_reconfigure::ConfigTools::appendParameter(message, name, value);
  });
  return message;
}

/// The struct with the message's values; fields missing in the message keep their values.
template <typename Params>
Params fromConfigMsg(const dynamic_reconfigure::Config& message, Params params) {
  forEachNumber(params, [&](const std::string& name, auto& value) {
    dynamic_reconfigure::ConfigTools::getParameter(message, name, value);
  });
  return params;
}

/// A generated configuration that is not clamped to its ranges: `apply` must see a value out of range to
/// refuse it.
template <typename Config>
struct Unclamped : Config {
  Unclamped() = default;
  Unclamped(const Config& config) : Config(config) {}
  void __clamp__() const {}
};

/// Serves `Params` below the private name `tuning`. A change is applied completely or not at all.
template <typename Config, typename Params>
class Reconfigure {
 public:
  /// \param apply called with each new struct; if it throws, the old one stays
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
