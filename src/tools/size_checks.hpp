/// Checks by check_overlay of the opening's and the vehicle's sizes in a parameter file.
#pragma once

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "evaluation/flights/told_sizes.hpp"
#include "params_file.hpp"
#include "simulation/scenario/scenario.hpp"
#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::tools {

inline void warn(const std::string& text) { std::cerr << "check_overlay: warning: " << text << "\n"; }

inline const std::vector<std::string> kOpening = {"homography_pose/pose/opening_width_m",
                                                  "homography_pose/pose/opening_height_m"};
inline const std::vector<std::string> kBody = {"vehicle/half_length_m", "vehicle/half_width_m",
                                               "vehicle/half_height_m"};

inline bool givesOpening(const configuration::Overlay& overlay) {
  return overlay.gives(kOpening[0]) && overlay.gives(kOpening[1]);
}

inline std::string sizeOf(const Eigen::Vector3d& half) {
  return formatted("%g x %g x %g m", 2.0 * half.x(), 2.0 * half.y(), 2.0 * half.z());
}
inline std::string sizeOf(const navigation::VehicleParams& vehicle) {
  return sizeOf(Eigen::Vector3d(vehicle.half_length_m, vehicle.half_width_m, vehicle.half_height_m));
}

/// What is missing of a size: `whole`, or the names of some of its keys; empty if nothing is.
inline std::string missing(const configuration::Overlay& overlay, const std::vector<std::string>& keys,
                           const std::string& whole) {
  std::vector<std::string> names;
  for (const std::string& key : keys)
    if (!overlay.gives(key)) names.push_back(key);
  if (names.empty()) return "";
  return (names.size() == keys.size() ? whole : parameters::joined(names)) + " is missing";
}

// A drone must not fly with the default window's size.
inline void checkOpeningIsGiven(const configuration::Overlay& overlay, bool is_refused) {
  const auto& pose = overlay.homography_pose.pose;
  const bool is_found_out = pose.scale_sigma > 0.0;  // measured in flight
  if (is_found_out || givesOpening(overlay)) return;
  const std::string fault = missing(overlay, kOpening, "the opening's size") +
                            ": measure it and give window_size:=W,H [m], or in the file of config:= "
                            "homography_pose: {pose: {opening_width_m: W, opening_height_m: H}}";
  if (is_refused) throw InputError(fault);
  warn(fault + "; assuming " + sizeOf(pose));
}

// A side that is not given keeps the default window's value.
inline void checkBothSides(const configuration::Overlay& overlay) {
  const bool width = overlay.gives(kOpening[0]), height = overlay.gives(kOpening[1]);
  if (width == height) return;
  const auto& pose = overlay.homography_pose.pose;
  warn(formatted("only one side of the opening is given: %s is missing, assuming %g m",
                 kOpening[width].c_str(), width ? pose.opening_height_m : pose.opening_width_m));
}

// A drone must not fly with the default vehicle's size either.
inline void checkVehicleIsGiven(const configuration::Overlay& overlay) {
  const std::string what = missing(overlay, kBody, "the vehicle's size");
  if (what.empty()) return;
  warn(what + ": assuming " + sizeOf(overlay.vehicle) +
       "; measure it, propellers included, and give in the file of config:= vehicle: "
       "{half_length_m: L, half_width_m: W, half_height_m: H}");
}

/// What flies in the simulated world: the sizes of the parameter file, else the world's.
inline configuration::Overlay flownIn(const simulation::Scenario& scenario, const std::string& file) {
  configuration::Overlay overlay = configuration::readOverlay(file);
  evaluation::tellSizes(scenario, overlay, overlay.vehicle, overlay.homography_pose.pose);
  return overlay;
}

/// Takes the argument; warns where it overrides the file.
inline void overrideWindowSize(const std::string& text, const std::string& file,
                               configuration::Overlay& overlay) {
  if (text.empty()) return;
  const bool has_width = overlay.gives(kOpening[0]), has_height = overlay.gives(kOpening[1]);
  overlay.given.insert(kOpening.begin(), kOpening.end());  // a wrong size is not missing as well
  const auto size = numbers("window_size", text, 2);
  estimation::PoseParams& pose = overlay.homography_pose.pose;
  const bool contradicts = (has_width && std::abs(pose.opening_width_m - size[0]) > 1e-9) ||
                           (has_height && std::abs(pose.opening_height_m - size[1]) > 1e-9);
  if (contradicts)
    warn(formatted("window_size %s overrides %s, which says %g,%g", text.c_str(), file.c_str(),
                   pose.opening_width_m, pose.opening_height_m));
  takeWindowSize("window_size", text, pose);
}

/// A size of vehicle or opening. \param name as in a parameter file
inline double sizeCalled(const std::string& name, configuration::Overlay overlay) {
  for (const auto& keys : {kBody, kOpening})
    if (std::find(keys.begin(), keys.end(), name) != keys.end())
      return parameters::find(parameters::fieldsOf(overlay), name)->get();
  throw InputError("--print " + name + ": not a size of vehicle or opening");
}

/// Where vehicle or opening in the file differ from the simulated world's; empty: nowhere.
inline std::string otherSizes(configuration::Overlay overlay, const simulation::Scenario& scenario) {
  evaluation::tellSizes(scenario, overlay, overlay.vehicle, overlay.homography_pose.pose);
  const auto differs = [&](const std::string& key, double fact) {
    return overlay.gives(key) && std::abs(sizeCalled(key, overlay) - fact) > 1e-6;
  };
  const auto opening = scenario.opening();
  const Eigen::Vector3d half = scenario.vehicle.halfExtents();
  std::string text;
  if (differs(kBody[0], half.x()) || differs(kBody[1], half.y()) || differs(kBody[2], half.z()))
    text += "a vehicle of " + sizeOf(overlay.vehicle) + ", the world has " + sizeOf(half);
  if (differs(kOpening[0], opening.width_m) || differs(kOpening[1], opening.height_m))
    text += (text.empty() ? "" : "; ") + ("an opening of " + sizeOf(overlay.homography_pose.pose)) +
            formatted(", the world has %g x %g m", opening.width_m, opening.height_m);
  return text.empty() ? ""
                      : "the file says " + text +
                            ": the navigator uses the file's sizes, the referee the world's; give a scenario "
                            "with your sizes (window, vehicle)";
}

/// Says that a reference in the file is not used, because the world shows one of its own window; else empty.
inline std::string otherReference(const configuration::Overlay& overlay) {
  return overlay.gives("window_detector/reference/picture")
             ? "window_detector/reference is not used: the simulated world shows a picture of its own window"
             : "";
}

/// Sizes of vehicle and opening, so that the user notices a mistyped one.
/// \param is_simulated the scenario gives the sizes that the file does not give
inline std::string understood(const configuration::Overlay& overlay, bool is_simulated) {
  const auto& vehicle = overlay.vehicle;
  const auto& pose = overlay.homography_pose.pose;
  const bool gives_vehicle =
      is_simulated || overlay.gives("vehicle/half_width_m") || overlay.gives("vehicle/half_height_m");
  const std::string body = "a vehicle of " + sizeOf(vehicle) + " (length, width, height" +
                           (gives_vehicle ? ")" : "; assumed: its size is not given)");
  if (pose.scale_sigma > 0.0) return body + " through an opening whose size is measured in flight";
  const double beside_m = 0.5 * pose.opening_width_m - vehicle.half_width_m;
  const double above_m = 0.5 * pose.opening_height_m - vehicle.half_height_m;
  return body + " through " + sizeOf(pose) +
         (is_simulated || givesOpening(overlay) ? "" : " (assumed: no size of the opening is given)") +
         (std::min(beside_m, above_m) <= 0.0
              ? ": it does not fit"
              : formatted(": %.2f m free on each side, %.2f m above and below", beside_m, above_m));
}

inline void checkFits(const navigation::VehicleParams& vehicle, const estimation::PoseParams& opening) {
  const double width_m = 2.0 * vehicle.half_width_m, height_m = 2.0 * vehicle.half_height_m;
  const double room_m = 2.0 * vehicle.margin_m;
  if (opening.scale_sigma > 0.0 ||
      (width_m + room_m < opening.opening_width_m && height_m + room_m < opening.opening_height_m))
    return;
  throw InputError(
      formatted("the vehicle, %g x %g m (twice vehicle/half_width_m, half_height_m), does not fit "
                "through the opening, %s, with %g m on each side (vehicle/margin_m): measure both",
                width_m, height_m, sizeOf(opening).c_str(), vehicle.margin_m));
}

}  // namespace window_ingress::tools
