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

/// How the approaches of a survey of openness are flown, and what is wrong with what is known on them.
struct OpennessRange {
  FlightRange flight{3.5, 6.0, 0.5, 1.2, 1.0, 0.05};
  double rate_hz = 10.0;         ///< of the images [1/s]
  double decide_m = 1.75;        ///< before the plane: the point of no return [m]
  double border_noise_px = 0.3;  ///< of each sample of a border, one a pixel [px]
  double border_bias_px = 0.3;   ///< of each border, lasting through the approach [px]
  double position_noise_m = 0.006, drift_m_per_sqrt_sec = 0.015;
  double attitude_noise_rad = 0.004, attitude_bias_rad = 0.01;
  double window_error_m = 0.05, window_error_rad = 0.03;  ///< of the filtered window, lasting
  double flow_noise_px = 0.3;                             ///< of synthetic points [px]
  double reflectivity = 0.5;  ///< of a glass pane: so many of its points are mirrored, the others in the room
};

/// What one approach ended with.
struct OpennessResult {
  std::string kind;
  bool is_open = false;  ///< the truth
  double room_m = 0.0;   ///< depth behind the border of what is seen, if known; else 0
  std::uint32_t seed = 0;
  openness::OpennessVerdict at_decision;
  bool ever_open = false, ever_closed = false;
  double open_from_m = 0.0;   ///< distance from the plane at which it was first called open; 0: never
  double milliseconds = 0.0;  ///< for following and judging an image, mean
};

/// One step of an approach, for those who plot it.
using OpennessStep = std::function<void(double plane_m, const openness::OpennessVerdict&)>;

/// An approach to the scenario's window, drawn and seen through its camera; borders are seen with noise.
/// \throws as `simulation::CameraSensor`
OpennessResult flyDrawn(const simulation::Scenario& scenario, std::uint32_t seed, const OpennessRange& range,
                        const openness::InteriorKltParams& follower, const openness::OpennessParams& params,
                        const OpennessStep& each = {});

/// What synthetic points within the border lie on.
enum class Interior {
  kPoster,   ///< the plane itself
  kPane,     ///< a plane up to 0.15 m behind it
  kCurtain,  ///< folds up to 0.3 m behind it, that sway
  kTilted,   ///< a shutter not quite shut: a plane that reaches up to 0.3 m in
  kPartly,   ///< half of it a board, half a room: not open
  kDirt,     ///< stuck to the lens
  kJump,     ///< a poster; the border jumps to another edge on the way: not open
  kMirror,   ///< a mirrored scene, 2 to 40 m behind the pane
  kGlass,    ///< a pane before a room: in it points of the room, mirrored ones, and a few of its own dirt
  kRoom      ///< a room 1 to 6 m deep with things in it: open
};
constexpr int kInteriors = static_cast<int>(Interior::kRoom) + 1;
const char* toString(Interior interior);

/// The same without images: points with noise, some of them wrong.
OpennessResult flySynthetic(Interior interior, std::uint32_t seed, const OpennessRange& range,
                            const openness::OpennessParams& params, const OpennessStep& each = {});

/// Kinds in the order in which they came.
class OpennessTable {
 public:
  void add(const OpennessResult& result);
  std::string markdown() const;
  int falseOpen() const;  ///< closed ones called open at any time

 private:
  struct Row {
    bool is_open = false;
    int flights = 0, open = 0, closed = 0, ever_open = 0, ever_closed = 0;
    std::vector<double> open_from_m, milliseconds;
  };
  std::vector<std::pair<std::string, Row>> rows_;
};

std::string opennessColumns();
std::string opennessRow(const OpennessResult& result);  ///< no line end

}  // namespace window_ingress::evaluation
