#include "window_ingress/simulation/vehicle_profiles.hpp"

namespace window_ingress::simulation {

void applyProfile(const std::string& profile, VehicleParams& vehicle, OdometryParams&) {
  vehicle.profile = profile;
}

}  // namespace window_ingress::simulation
