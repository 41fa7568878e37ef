#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "evaluation/flights/flight_observer.hpp"
#include "evaluation/flights/flight_summary.hpp"
#include "evaluation/flights/flight_timing.hpp"
#include "evaluation/flights/projected_detector.hpp"
#include "simulation/scenario/scenario.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/estimation/pose_params.hpp"
#include "window_ingress/estimation/target_estimator.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/openness/interior_klt_params.hpp"

namespace window_ingress::evaluation {

/// Everything that flies.
struct FlightParams {
  detection::DetectorParams detector;
  openness::InteriorKltParams interior;
  estimation::PoseParams pose;
  estimation::FilterParams filter;
  estimation::TargetEstimatorParams tracker;
  navigation::NavigatorParams navigator;
  double step_rate_hz = 30.0;   ///< of the navigator [1/s]
  bool without_images = false;  ///< the window is seen by `ProjectedDetector`, no image is drawn
  SightParams sight;
  std::set<std::string>
      said;  ///< by the operator: "vehicle/half_width_m"; what is not is taken from the world
};

/// What a user's file says to the nodes, for a flight. \throws parameters::YamlError
FlightParams readFlightParams(const std::string& file);

/// One flight in one process, by the objects that the nodes use: the world's images through detector, pose
/// and filter to the navigator, and its setpoints back. Deterministic: scenario, seed and parameters give the
/// same result to the bit. The opening's size, the vehicle's body and its camera are known facts and taken
/// from the world, unless the operator says otherwise. \param timing the flight's is added to it \throws
/// simulation::ScenarioError, std::invalid_argument (parameters), std::runtime_error (no renderer). Without
/// images, observers are not shown any.
FlightResult flyOnce(const simulation::Scenario& scenario, std::uint32_t seed, const FlightParams& params,
                     const std::vector<FlightObserver*>& observers = {}, FlightTiming* timing = nullptr);

}  // namespace window_ingress::evaluation
