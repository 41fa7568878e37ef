/// Parameter structs from the ROS parameter server, by the same `visit` as yaml files
/// (parameters/fields.hpp).
#pragma once

#include <XmlRpcValue.h>
#include <ros/node_handle.h>

#include <set>
#include <string>
#include <vector>

#include "window_ingress/navigation/vehicle_params.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

/// Fills the fields from the tree below one namespace. Missing parameters keep their defaults; a double may
/// be given as an int. \param others permitted names that other code reads \return all faults: wrong types,
/// numbers out of range, unknown names
std::vector<std::string> readTree(const std::string& name_space, XmlRpc::XmlRpcValue tree,
                                  const std::vector<parameters::Field>& fields,
                                  const std::set<std::string>& others = {});

/// Fills the fields from all parameters below the namespace of `nh`. \throws InputError if that is not a
/// namespace
std::vector<std::string> readFields(const ros::NodeHandle& nh, const std::vector<parameters::Field>& fields,
                                    const std::set<std::string>& others = {});

/// \throws InputError with one line that names each fault, if there are any: the node must not start
void refuseFaulty(const std::vector<std::string>& faults);

/// Reads the parameters of one node. \throws InputError
template <typename Params>
Params readParameters(const ros::NodeHandle& pnh) {
  Params params;
  refuseFaulty(readFields(pnh, parameters::fieldsOf(params)));
  return params;
}

/// Reads the parameters of one node and the common ones of the vehicle (`vehicle`, beside the nodes). \throws
/// InputError that lists the faults of both
template <typename Params>
Params readParameters(const ros::NodeHandle& nh, const ros::NodeHandle& pnh,
                      navigation::VehicleParams& vehicle, const std::set<std::string>& others = {}) {
  Params params;
  std::vector<std::string> faults = readFields(pnh, parameters::fieldsOf(params), others);
  for (const std::string& fault : readFields(ros::NodeHandle(nh, "vehicle"), parameters::fieldsOf(vehicle)))
    faults.push_back(fault);
  refuseFaulty(faults);
  return params;
}

}  // namespace window_ingress::adapters
