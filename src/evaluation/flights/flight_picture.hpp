/// Images of flights for people.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "evaluation/flights/flight_observer.hpp"
#include "evaluation/flights/flight_results.hpp"

namespace window_ingress::evaluation {

/// All tracks, seen from above (upper part) and from the right side (lower part), coloured by outcome, in the
/// window's frame: the scenario's wall at x = 0, outside at x < 0. CV_8UC3.
cv::Mat drawTracks(const std::vector<FlightResult>& flights, const simulation::Scenario& scenario,
                   const std::string& title);

/// Keeps camera images with the detector's drawing on them: the first of each state of the navigator, and the
/// very last one.
class FlightStrip : public FlightObserver {
 public:
  static constexpr std::size_t kMax = 11;  ///< images besides the last one

  void onImage(const simulation::CameraFrame& frame, const detection::DetectionTrace& trace,
               const std::optional<detection::WindowObservation>& window) override;
  void onStep(const FlightRecord& record, const navigation::NavigatorOutput& output) override;

  /// All kept images with time and state, below the flight's track. CV_8UC3; empty if there was no image.
  cv::Mat draw(const FlightResult& flight, const simulation::Scenario& scenario) const;

 private:
  struct Picture {
    cv::Mat image;
    std::string caption;
  };
  std::vector<Picture> pictures_;
  Picture last_;
  cv::Mat canvas_;
  std::optional<navigation::State> shown_;
};

}  // namespace window_ingress::evaluation
