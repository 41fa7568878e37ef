#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/images/survey_flight.hpp"
#include "simulation/scenario/scenario.hpp"
#include "window_ingress/openness/interior_klt_params.hpp"
#include "window_ingress/openness/openness_params.hpp"
#include "window_ingress/openness/openness_verdict.hpp"

namespace window_ingress::evaluation {

/// Flights and errors of a survey of openness.
struct OpennessRange {
  FlightRange flight{3.5, 6.0, 0.5, 1.2, 1.0, 0.05};
  double rate_hz = 10.0;         ///< image rate [1/s]
  double decide_m = 1.75;        ///< distance of the point of no return from the plane [m]
  double border_noise_px = 0.3;  ///< noise of each border sample, one per pixel [px]
  double border_bias_px = 0.3;   ///< error of each border, constant during the approach [px]
  double position_noise_m = 0.006, drift_m_per_sqrt_sec = 0.015;
  double attitude_noise_rad = 0.004, attitude_bias_rad = 0.01;
  double window_error_m = 0.05, window_error_rad = 0.03;  ///< of the filtered window, constant
  double flow_noise_px = 0.3;                             ///< of synthetic points [px]
  double reflectivity = 0.5;  ///< share of mirrored points of a glass pane; the others are in the room
};

/// Result of one approach.
struct OpennessResult {
  std::string kind;
  bool is_open = false;  ///< the truth
  double room_m = 0.0;   ///< true depth of the scene behind the border, if known; else 0
  std::uint32_t seed = 0;
  openness::OpennessVerdict at_decision;
  bool ever_open = false, ever_closed = false;
  double open_from_m = 0.0;   ///< distance from the plane at which it was first called open; 0: never
  double milliseconds = 0.0;  ///< mean time for tracking and judging an image
};

/// Called for each step of an approach, e.g. for a plot.
using OpennessStep = std::function<void(double plane_m, const openness::OpennessVerdict&)>;

/// An approach to the scenario's window with rendered images; borders have noise.
/// \throws as `simulation::CameraSensor`
OpennessResult flyDrawn(const simulation::Scenario& scenario, std::uint32_t seed, const OpennessRange& range,
                        const openness::InteriorKltParams& follower, const openness::OpennessParams& params,
                        const OpennessStep& each = {});

/// Surface on which synthetic points within the border lie.
enum class Interior {
  kPoster,   ///< the plane itself
  kPane,     ///< a plane up to 0.15 m behind it
  kCurtain,  ///< swaying folds up to 0.3 m behind it
  kTilted,   ///< a shutter left ajar: a plane up to 0.3 m deep
  kPartly,   ///< half board, half room: not open
  kDirt,     ///< dirt on the lens
  kJump,     ///< a poster, while the border jumps to another edge: not open
  kMirror,   ///< a mirrored scene, 2 to 40 m behind the pane
  kGlass,    ///< a pane in front of a room: points of the room, mirrored ones, and a few dirt points
  kRoom      ///< a room 1 to 6 m deep with things in it: open
};
constexpr int kInteriors = static_cast<int>(Interior::kRoom) + 1;
const char* toString(Interior interior);

/// The same without images: noisy points, some of them wrong.
OpennessResult flySynthetic(Interior interior, std::uint32_t seed, const OpennessRange& range,
                            const openness::OpennessParams& params, const OpennessStep& each = {});

/// Kinds in the order of arrival.
class OpennessTable {
 public:
  void add(const OpennessResult& result);
  std::string markdown() const;
  int falseOpen() const { return false_open_; }  ///< closed ones judged open at any time

 private:
  struct Row {
    bool is_open = false;  ///< the last one, where a scenario draws it
    int flights = 0, open = 0, closed = 0, ever_open = 0, ever_closed = 0;
    std::vector<double> open_from_m, milliseconds;
  };
  std::vector<std::pair<std::string, Row>> rows_;
  int false_open_ = 0;
};

std::string opennessColumns();
std::string opennessRow(const OpennessResult& result);  ///< without line end

}  // namespace window_ingress::evaluation
