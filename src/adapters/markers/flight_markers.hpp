/// What rviz shows of the flight.
#pragma once

#include <ros/time.h>
#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "window_ingress/navigation/navigator.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::adapters {

/// A state of the navigator: the colours of plot_flight (tools/ingress_tools/flight_data.py).
std_msgs::ColorRGBA colourOf(navigation::State state, double alpha = 1.0);

constexpr int kSetpointRgb = 0xff3fa4;  ///< what the navigator wishes

/// The way flown, with the state at each place. Bounded: when it is full, every other place is dropped.
class FlightTrail {
 public:
  struct Place {
    Eigen::Vector3d position_odom_m;
    navigation::State state;
  };

  /// Places nearer than the spacing to the last one are left out, unless the state has changed.
  void add(const Eigen::Vector3d& position_odom_m, navigation::State state);
  void clear() { *this = FlightTrail(); }
  const std::vector<Place>& places() const { return places_; }

 private:
  std::vector<Place> places_;
  double spacing_m_ = 0.05;
};

/// A cross-section of the funnel: where the body's centre, with three standard deviations, must be for
/// forward flight at this distance to the window's plane.
struct FunnelSection {
  double distance_m = 0.0;
  double half_width_m = 0.0, half_height_m = 0.0;
};

/// From the plane over the commit line outwards, as the navigator itself judges them for this vehicle; empty
/// if the vehicle does not fit.
std::vector<FunnelSection> funnelOf(const navigation::VehicleState& vehicle,
                                    const navigation::TargetEstimate& target,
                                    const navigation::NavigatorParams& params);

/// The vehicle as a box of its true size in the colour of its state, what its camera sees, the way flown in
/// the colours of the states, the setpoint as the way of the next second, the state in words; and while the
/// sign of the target is trusted, the funnel with the commit line.
visualization_msgs::MarkerArray flightMarkers(const navigation::NavigatorOutput& output,
                                              const navigation::NavigatorInput& input,
                                              const FlightTrail& trail,
                                              const navigation::NavigatorParams& params,
                                              const ros::Time& stamp, const std::string& odom_frame);

}  // namespace window_ingress::adapters
