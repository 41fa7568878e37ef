#include "adapters/markers/flight_markers.hpp"

#include <cmath>

#include "adapters/markers/marker_colours.hpp"
#include "adapters/markers/marker_sketch.hpp"
#include "window_ingress/navigation/commit_criterion.hpp"

namespace window_ingress::adapters {
namespace {

using navigation::NavigatorParams;

constexpr std::size_t kMaxPlaces = 2000;
constexpr double kFunnelM = 1.5;     // length of the part outside the commit line
constexpr double kViewM = 0.35;      // length of the pyramid that shows the camera's view
constexpr double kTextBelowM = 0.6;  // above are the texts of the windows
constexpr std::size_t kTextWidth = 30;
constexpr int kTurnParts = 10;

Points sectionCorners(const Eigen::Isometry3d& T_odom_window, const FunnelSection& section) {
  Points corners;
  for (Eigen::Vector3d corner :
       geometry::openingCorners({2.0 * section.half_width_m, 2.0 * section.half_height_m})) {
    corner.x() = -section.distance_m;
    corners.push_back(T_odom_window * corner);
  }
  return corners;
}

void appendRing(Points& strokes, const Points& corners) {
  for (int i = 0; i < 4; ++i) {
    strokes.push_back(corners[i]);
    strokes.push_back(corners[(i + 1) % 4]);
  }
}

// Draws edges only, because faces would take clicks meant for windows behind the funnel.
void drawFunnel(MarkerSketch& sketch, const Eigen::Isometry3d& T_odom_window,
                const std::vector<FunnelSection>& sections) {
  Points edges, commit_line;
  for (std::size_t i = 0; i + 1 < sections.size(); ++i) {
    const Points near = sectionCorners(T_odom_window, sections[i]),
                 far = sectionCorners(T_odom_window, sections[i + 1]);
    for (int k = 0; k < 4; ++k) edges.insert(edges.end(), {near[k], far[k]});
    if (i == 0) appendRing(commit_line, far);
    if (i > 0) appendRing(edges, far);
  }
  sketch.strokes("funnel", edges, colourOf(navigation::State::kApproach, 0.6));
  sketch.strokes("commit line", commit_line, colourOf(navigation::State::kCommit));
}

void drawTrail(MarkerSketch& sketch, const FlightTrail& trail, const Eigen::Vector3d& now_at,
               navigation::State state) {
  Points points;
  std::vector<std_msgs::ColorRGBA> colours;
  for (const FlightTrail::Place& place : trail.places()) {
    points.push_back(place.position_odom_m);
    colours.push_back(colourOf(place.state));
  }
  points.push_back(now_at);
  colours.push_back(colourOf(state));
  sketch.line("way flown", points, colours);
}

void drawCamera(MarkerSketch& sketch, const Eigen::Isometry3d& T_odom_base,
                const navigation::VehicleParams& vehicle) {
  const Eigen::Vector3d eye(vehicle.camera.forward_m, 0.0, 0.0);
  const double y_m = kViewM * std::tan(0.5 * vehicle.camera.horizontal_fov_rad);
  const double z_m = kViewM * std::tan(0.5 * vehicle.camera.vertical_fov_rad);
  Points strokes, corners;
  for (const auto& [y, z] : {std::pair{y_m, z_m}, {-y_m, z_m}, {-y_m, -z_m}, {y_m, -z_m}}) {
    corners.push_back(T_odom_base * (eye + Eigen::Vector3d(kViewM, y, z)));
    strokes.insert(strokes.end(), {T_odom_base * eye, corners.back()});
  }
  appendRing(strokes, corners);
  sketch.strokes("camera", strokes, colourOf(kTextRgb, 0.5));
}

// Direction of the nose over the next second.
void drawTurn(MarkerSketch& sketch, const Eigen::Isometry3d& T_odom_base,
              const navigation::Setpoint& setpoint) {
  constexpr double kRadiusM = 0.6, kSlowestRadps = 0.02;
  if (std::abs(setpoint.yaw_rate_radps) < kSlowestRadps) return sketch.gone("setpoint: turn");
  const Eigen::Vector3d nose = T_odom_base.linear() * Eigen::Vector3d(kRadiusM, 0.0, 0.0);
  Points arc;
  for (int part = 0; part <= kTurnParts; ++part)
    arc.push_back(T_odom_base.translation() +
                  Eigen::AngleAxisd(setpoint.yaw_rate_radps * part / kTurnParts, Eigen::Vector3d::UnitZ()) *
                      nose);
  sketch.line("setpoint: turn", arc, colourOf(kSetpointRgb));
}

}  // namespace

void FlightTrail::add(const Eigen::Vector3d& position_odom_m, navigation::State state) {
  if (!position_odom_m.allFinite()) return;
  const bool is_new = places_.empty() || places_.back().state != state ||
                      (places_.back().position_odom_m - position_odom_m).norm() >= spacing_m_;
  if (!is_new) return;
  places_.push_back({position_odom_m, state});
  if (places_.size() < kMaxPlaces) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < places_.size(); i += 2) places_[kept++] = places_[i];
  places_.resize(kept);
  spacing_m_ *= 2.0;
}

std::vector<FunnelSection> funnelOf(const navigation::VehicleState& vehicle,
                                    const navigation::TargetEstimate& target, const NavigatorParams& params) {
  navigation::CommitCriterionInput input;
  input.relative = navigation::relate(vehicle, target);
  input.opening = target.opening;
  input.pitch_rad = navigation::pitchOf(vehicle);
  const double line_m = navigation::evaluateCommitCriterion(input, params).commit_distance_m;
  std::vector<FunnelSection> sections;
  for (const double distance_m : {0.0, line_m, line_m + kFunnelM}) {
    input.relative.position_window_m.x() = -distance_m;
    const navigation::CommitCriterion criterion = navigation::evaluateCommitCriterion(input, params);
    if (!criterion.hasClearance()) return {};
    sections.push_back({distance_m, criterion.clearance_m.x() + criterion.funnel_m,
                        criterion.clearance_m.y() + criterion.funnel_m});
  }
  return sections;
}

visualization_msgs::MarkerArray flightMarkers(const navigation::NavigatorOutput& output,
                                              const navigation::NavigatorInput& input,
                                              const FlightTrail& trail, const NavigatorParams& params,
                                              const ros::Time& stamp, const std::string& odom_frame) {
  MarkerSketch sketch(stamp, odom_frame);
  if (!input.vehicle) return sketch.markers();
  const Eigen::Isometry3d& T_odom_base = input.vehicle->T_odom_base;
  const Eigen::Vector3d position = T_odom_base.translation();
  const auto& body = params.vehicle;
  sketch.box("vehicle", T_odom_base, {body.half_length_m, body.half_width_m, body.half_height_m},
             colourOf(output.state, 0.85));
  drawCamera(sketch, T_odom_base, body);
  drawTrail(sketch, trail, position, output.state);
  sketch.arrow("setpoint", position, position + output.setpoint.velocity_odom_mps, colourOf(kSetpointRgb));
  drawTurn(sketch, T_odom_base, output.setpoint);
  sketch.text("state", position - Eigen::Vector3d(0.0, 0.0, kTextBelowM),
              std::string(navigation::toString(output.state)) + "\n" + wrapped(output.reason, kTextWidth));
  Eigen::Isometry3d T_odom_window = Eigen::Isometry3d::Identity();
  std::vector<FunnelSection> sections;
  if (input.target && input.target->sign_trusted) {
    T_odom_window = geometry::makePose(navigation::uprightRotation(*input.target),
                                       input.target->T_odom_window.translation());
    sections = funnelOf(*input.vehicle, *input.target, params);
  }
  drawFunnel(sketch, T_odom_window, sections);
  return sketch.markers();
}

}  // namespace window_ingress::adapters
