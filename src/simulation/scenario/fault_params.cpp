#include "simulation/scenario/fault_params.hpp"

namespace window_ingress::simulation {

std::string whyNoSuchFault(const FaultParams& fault) {
  const std::string what = fault.unit + " " + fault.kind + ": ";
  if (fault.unit == "clock" && fault.kind == "garbage")
    return what + "a time has no bits that are no time; take wrong";
  if (fault.kind == "slide" && fault.unit != "odom") return what + "only odom slides";
  if (fault.unit == "camera_info" && fault.kind == "stuck")
    return what + "the calibration never changes; take off or wrong";
  return "";
}

std::string whyNotBesideExternalVehicle(const FaultParams& fault) {
  if (fault.unit == "image" || fault.unit == "camera_info") return "";
  return fault.unit + " " + fault.kind + ": with vehicle external, " + fault.unit + " is not the world's";
}

}  // namespace window_ingress::simulation
