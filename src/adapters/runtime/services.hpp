#pragma once

#include <ros/node_handle.h>

#include <string>

#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

/// Advertises a service whose response has the fields of a `Reply`, which `act(request)` returns.
template <typename Service, typename Act>
ros::ServiceServer advertise(ros::NodeHandle& nh, const std::string& name, Act act) {
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  return nh.advertiseService<Request, Response>(name, [act](Request& request, Response& response) {
    const Reply reply = act(request);
    response.success = reply.success;
    response.message = reply.message;
    return true;
  });
}

}  // namespace window_ingress::adapters
