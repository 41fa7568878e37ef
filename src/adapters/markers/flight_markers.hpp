/// Markers of the flight for rviz.
#pragma once

#include <ros/time.h>
#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "window_ingress/navigation/navigator.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::adapters {

/// The flown path with the state at each place. Bounded: when full, it drops every other place.
class FlightTrail {
 public:
  struct Place {
    Eigen::Vector3d position_odom_m;
    navigation::State state;
  };

  /// Skips a place nearer than the spacing to the last one, unless the state has changed.
  void add(const Eigen::Vector3d& position_odom_m, navigation::State state);
  void clear() { *this = FlightTrail(); }
  const std::vector<Place>& places() const { return places_; }

 private:
  std::vector<Place> places_;
  double spacing_m_ = 0.05;
};

/// A cross-section of the funnel: permits forward flight at this distance to the window's plane if the body's
/// centre lies inside with three standard deviations.
struct FunnelSection {
  double distance_m = 0.0;
  double half_width_m = 0.0, half_height_m = 0.0;
};

/// Cross-sections from the plane across the commit line outwards, by the navigator's rules for this vehicle;
/// empty if the vehicle does not fit.
std::vector<FunnelSection> funnelOf(const navigation::VehicleState& vehicle,
                                    const navigation::TargetEstimate& target,
                                    const navigation::NavigatorParams& params);

/// The vehicle as a box of its true size in the colour of its state, its camera's view, the flown path in the
/// colours of the states, the setpoint as the path of the next second, and the state as text. With a trusted
/// sign also the funnel and the commit line.
visualization_msgs::MarkerArray flightMarkers(const navigation::NavigatorOutput& output,
                                              const navigation::NavigatorInput& input,
                                              const FlightTrail& trail,
                                              const navigation::NavigatorParams& params,
                                              const ros::Time& stamp, const std::string& odom_frame);

}  // namespace window_ingress::adapters
