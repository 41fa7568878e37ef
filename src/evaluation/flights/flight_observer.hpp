#pragma once

#include <optional>

#include "evaluation/flights/flight_record.hpp"
#include "simulation/world.hpp"
#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/navigation/navigator.hpp"

namespace window_ingress::evaluation {

/// Looks on while a flight is flown, and changes nothing: a flight is the same to the bit with and without.
/// What is handed over is valid during the call only.
class FlightObserver {
 public:
  virtual ~FlightObserver() = default;

  /// Once, before everything else.
  virtual void onStart(const simulation::World&) {}
  /// Each image, with what the detector made of it.
  virtual void onImage(const simulation::CameraFrame&, const detection::DetectionTrace&,
                       const std::optional<detection::WindowObservation>&) {}
  virtual void onCalibration(const simulation::CalibrationSample&) {}
  virtual void onOdometry(const simulation::OdometrySample&) {}
  virtual void onImu(const simulation::ImuSample&) {}
  /// Each step of the navigator, with the truth beside it.
  virtual void onStep(const FlightRecord&, const navigation::NavigatorOutput&) {}
  /// Once, after everything else; the last chance to throw.
  virtual void onEnd() {}
};

}  // namespace window_ingress::evaluation
