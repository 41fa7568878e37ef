/// Checks by check_overlay of the opening's and the vehicle's sizes in a parameter file.
#pragma once

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
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

inline const std::vector<const char*> kOpening = {"homography_pose/pose/opening_width_m",
                                                  "homography_pose/pose/opening_height_m"};
inline const std::vector<const char*> kBody = {"vehicle/half_length_m", "vehicle/half_width_m",
                                               "vehicle/half_height_m"};

inline bool says(const configuration::Overlay& overlay, const char* key) {
  return overlay.said.count(key) != 0;
}

inline bool saysOpening(const configuration::Overlay& overlay) {
  return says(overlay, kOpening[0]) && says(overlay, kOpening[1]);
}

/// What is missing of a size: `whole`, or the names of some of its keys; empty if nothing is.
inline std::string missing(const configuration::Overlay& overlay, const std::vector<const char*>& keys,
                           const char* whole) {
  std::vector<std::string> names;
  for (const char* key : keys)
    if (!says(overlay, key)) names.emplace_back(key);
  if (names.empty()) return "";
  return names.size() == keys.size() ? std::string(whole) + " is missing"
                                     : parameters::joined(names) + " is missing";
}

// A drone must not fly with the default window's size.
inline void checkOpeningIsSaid(const configuration::Overlay& overlay, bool is_refused) {
  const auto& pose = overlay.homography_pose.pose;
  const bool is_found_out = pose.scale_sigma > 0.0;  // measured in flight
  if (is_found_out || saysOpening(overlay)) return;
  const std::string said = missing(overlay, kOpening, "the opening's size") +
                           ": measure it and give window_size:=W,H [m], or in the file of config:= "
                           "homography_pose: {pose: {opening_width_m: W, opening_height_m: H}}";
  if (is_refused) throw InputError(said);
  warn(said + formatted("; assuming %g x %g m", pose.opening_width_m, pose.opening_height_m));
}

// A side that is not given keeps the default window's value.
inline void checkBothSides(const configuration::Overlay& overlay) {
  const bool width = says(overlay, kOpening[0]), height = says(overlay, kOpening[1]);
  if (width == height) return;
  const auto& pose = overlay.homography_pose.pose;
  warn(formatted("only one side of the opening is given: %s is missing, assuming %g m", kOpening[width],
                 width ? pose.opening_height_m : pose.opening_width_m));
}

// A drone must not fly with the default vehicle's size either.
inline void checkVehicleIsSaid(const configuration::Overlay& overlay) {
  const std::string what = missing(overlay, kBody, "the vehicle's size");
  if (what.empty()) return;
  const auto& vehicle = overlay.vehicle;
  warn(what + formatted(": assuming %g x %g x %g m; measure it, propellers included, "
                        "and give in the file of config:= vehicle: "
                        "{half_length_m: L, half_width_m: W, half_height_m: H}",
                        2.0 * vehicle.half_length_m, 2.0 * vehicle.half_width_m,
                        2.0 * vehicle.half_height_m));
}

/// What flies in the simulated world: the sizes of the parameter file, else the world's.
inline configuration::Overlay flownIn(const simulation::Scenario& scenario, const std::string& file) {
  configuration::Overlay overlay = configuration::readOverlay(file);
  evaluation::tellSizes(scenario, overlay.said, overlay.vehicle, overlay.homography_pose.pose);
  return overlay;
}

// Detects width and height exchanged, or one of them misread. An oblique view differs by less.
inline void checkAspect(double in_image, const estimation::PoseParams& opening) {
  constexpr double kMaxRatio = 1.25;
  const double said = opening.opening_width_m / opening.opening_height_m;
  if (opening.scale_sigma > 0.0 || std::max(in_image / said, said / in_image) <= kMaxRatio) return;
  warn(
      formatted("the opening, %g x %g m, is %.3g times as wide as it is high, but %.3g times in the "
                "reference image: measure both sides and check the corners",
                opening.opening_width_m, opening.opening_height_m, said, in_image));
}

/// Takes the argument; warns where it overrides the file.
inline void overrideWindowSize(const std::string& text, const std::string& file,
                               configuration::Overlay& overlay) {
  if (text.empty()) return;
  const auto size = numbers("window_size", text, 2);
  estimation::PoseParams& pose = overlay.homography_pose.pose;
  const auto contradicts = [&](const char* key, double in_file, double given) {
    return overlay.said.count(std::string("homography_pose/pose/") + key) != 0 &&
           std::abs(in_file - given) > 1e-9;
  };
  if (contradicts("opening_width_m", pose.opening_width_m, size[0]) ||
      contradicts("opening_height_m", pose.opening_height_m, size[1])) {
    warn(formatted("window_size %s overrides %s, which says %g,%g", text.c_str(), file.c_str(),
                   pose.opening_width_m, pose.opening_height_m));
  }
  takeWindowSize("window_size", text, pose);
  overlay.said.insert(kOpening.begin(), kOpening.end());
}

/// Where vehicle or opening in the file differ from the simulated world's; empty: nowhere.
inline std::string otherSizes(configuration::Overlay overlay, const simulation::Scenario& scenario) {
  evaluation::tellSizes(scenario, overlay.said, overlay.vehicle, overlay.homography_pose.pose);
  const auto differs = [&](const char* key, double said, double fact) {
    return overlay.said.count(key) != 0 && std::abs(said - fact) > 1e-6;
  };
  const auto opening = scenario.opening();
  const Eigen::Vector3d half = scenario.vehicle.halfExtents();
  const auto& vehicle = overlay.vehicle;
  const auto& pose = overlay.homography_pose.pose;
  std::string text;
  if (differs("vehicle/half_length_m", vehicle.half_length_m, half.x()) ||
      differs("vehicle/half_width_m", vehicle.half_width_m, half.y()) ||
      differs("vehicle/half_height_m", vehicle.half_height_m, half.z()))
    text += formatted("a vehicle of %g x %g x %g m, the world has %g x %g x %g m",
                      2.0 * vehicle.half_length_m, 2.0 * vehicle.half_width_m, 2.0 * vehicle.half_height_m,
                      2.0 * half.x(), 2.0 * half.y(), 2.0 * half.z());
  if (differs("homography_pose/pose/opening_width_m", pose.opening_width_m, opening.width_m) ||
      differs("homography_pose/pose/opening_height_m", pose.opening_height_m, opening.height_m))
    text += (text.empty() ? "" : "; ") + formatted("an opening of %g x %g m, the world has %g x %g m",
                                                   pose.opening_width_m, pose.opening_height_m,
                                                   opening.width_m, opening.height_m);
  return text.empty() ? ""
                      : "the file says " + text +
                            ": the navigator uses the file's sizes, the referee the world's; give a scenario "
                            "with your sizes (window, vehicle)";
}

/// \param name as in a parameter file
inline double sizeCalled(const std::string& name, const configuration::Overlay& overlay) {
  const auto& vehicle = overlay.vehicle;
  const auto& pose = overlay.homography_pose.pose;
  const std::map<std::string, double> sizes = {
      {"vehicle/half_length_m", vehicle.half_length_m},
      {"vehicle/half_width_m", vehicle.half_width_m},
      {"vehicle/half_height_m", vehicle.half_height_m},
      {"homography_pose/pose/opening_width_m", pose.opening_width_m},
      {"homography_pose/pose/opening_height_m", pose.opening_height_m}};
  if (const auto size = sizes.find(name); size != sizes.end()) return size->second;
  throw InputError("--print " + name + ": not a size of vehicle or opening");
}

/// Sizes of vehicle and opening, so that the user notices a mistyped one.
inline std::string understood(const configuration::Overlay& overlay) {
  const auto& vehicle = overlay.vehicle;
  const auto& pose = overlay.homography_pose.pose;
  const std::string body =
      formatted("a vehicle of %g x %g x %g m (length, width, height)", 2.0 * vehicle.half_length_m,
                2.0 * vehicle.half_width_m, 2.0 * vehicle.half_height_m);
  if (pose.scale_sigma > 0.0) return body + " through an opening whose size is measured in flight";
  return body + formatted(" through %g x %g m%s: %.2f m free on each side, %.2f m above and below",
                          pose.opening_width_m, pose.opening_height_m,
                          saysOpening(overlay) ? "" : " (assumed: no size of the opening is given)",
                          0.5 * pose.opening_width_m - vehicle.half_width_m,
                          0.5 * pose.opening_height_m - vehicle.half_height_m);
}

inline void checkFits(const navigation::VehicleParams& vehicle, const estimation::PoseParams& opening) {
  const double width_m = 2.0 * vehicle.half_width_m, height_m = 2.0 * vehicle.half_height_m;
  const double room_m = 2.0 * vehicle.margin_m;
  if (opening.scale_sigma > 0.0 ||
      (width_m + room_m < opening.opening_width_m && height_m + room_m < opening.opening_height_m))
    return;
  throw InputError(
      formatted("the vehicle, %g x %g m (twice vehicle/half_width_m, half_height_m), does not fit "
                "through the opening, %g x %g m, with %g m on each side (vehicle/margin_m): measure both",
                width_m, height_m, opening.opening_width_m, opening.opening_height_m, vehicle.margin_m));
}

}  // namespace window_ingress::tools
