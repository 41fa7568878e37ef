/// Parameter structs from the ROS parameter server, by the same `visit` as yaml files
/// (parameters/fields.hpp).
#pragma once

#include <XmlRpcValue.h>
#include <ros/node_handle.h>

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "window_ingress/navigation/vehicle_params.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/parameters/key_list.hpp"
#include "window_ingress/text/input_error.hpp"

namespace window_ingress::adapters {

/// Visitor over the tree below one namespace. Missing parameters keep their defaults; a double may be given
/// as an int; wrong types, numbers out of range and names that nobody asked for are collected.
class ParameterReader {
 public:
  /// \param known all names that may stand there, to say which may have been meant
  ParameterReader(const std::string& name_space, const XmlRpc::XmlRpcValue& tree,
                  const std::vector<std::string>& known = {});

  void operator()(const std::string& name, double& value, double minimum, double maximum);
  void operator()(const std::string& name, int& value, double minimum, double maximum);
  void operator()(const std::string& name, bool& value);
  void operator()(const std::string& name, std::string& value);
  void operator()(const std::string& name, std::vector<double>& value);  ///< a list of finite numbers
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& allowed);
  template <typename Params>
  void group(const std::string& name, Params& params) {
    ParameterReader child = descend(name);
    Params::visit(params, child);
    adopt(child);
  }

  /// Names that are read by others: below the namespace, and no error.
  void ignore(const std::set<std::string>& names) { asked_.insert(names.begin(), names.end()); }
  /// What another reader found is wrong here, too.
  void adopt(const ParameterReader& other);

  /// Everything wrong so far, unknown names included; empty if nothing is.
  std::vector<std::string> faults() const;
  void throwIfFaulty() const;  ///< \throws InputError

 private:
  const XmlRpc::XmlRpcValue* find(const std::string& name);
  ParameterReader descend(const std::string& name);
  void wrongType(const std::string& name, const char* expected, const XmlRpc::XmlRpcValue& found);
  void checkRange(const std::string& name, double number, double minimum, double maximum);

  std::string name_space_, path_;  // the latter from the node's own namespace on
  std::vector<std::string> known_;
  XmlRpc::XmlRpcValue tree_;
  std::set<std::string> asked_;
  std::vector<std::string> faults_;
};

/// All parameters below the namespace of `nh`, an empty struct if there are none. \throws InputError if
/// there stands anything else
XmlRpc::XmlRpcValue parameterTree(const ros::NodeHandle& nh);

/// What stands below the namespace of `nh`, which `Params::visit` lists, and what is wrong with it.
/// \throws InputError as `parameterTree`
template <typename Params>
ParameterReader readInto(Params& params, const ros::NodeHandle& nh,
                         const std::set<std::string>& others = {}) {
  ParameterReader reader(nh.getNamespace(), parameterTree(nh), parameters::keysOf(params));
  reader.ignore(others);
  Params::visit(params, reader);
  return reader;
}

/// Reads the parameters of one node. \throws InputError
template <typename Params>
Params readParameters(const ros::NodeHandle& pnh) {
  Params params;
  readInto(params, pnh).throwIfFaulty();
  return params;
}

/// The same, and what all nodes know of the vehicle: `vehicle`, beside the nodes. \throws InputError that
/// says what is wrong in both
template <typename Params>
Params readParameters(const ros::NodeHandle& nh, const ros::NodeHandle& pnh,
                      navigation::VehicleParams& vehicle, const std::set<std::string>& others = {}) {
  Params params;
  ParameterReader reader = readInto(params, pnh, others);
  reader.adopt(readInto(vehicle, ros::NodeHandle(nh, "vehicle")));
  reader.throwIfFaulty();
  return params;
}

}  // namespace window_ingress::adapters
