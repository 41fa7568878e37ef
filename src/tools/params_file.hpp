/// Contents of the --params file for tools that process images.
#pragma once

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::tools {

/// Warning for a reference without corners.
constexpr const char* kGuessedOpening =
    "the opening in the reference image is guessed, often wrongly: give its corners; 'ingress reference' "
    "finds and writes them";

constexpr const char* kAnyWindow = "no --reference: any window counts, also one that is not the target";

/// Why windows found may be others than the target; empty: they are not.
inline std::string doubtOf(const std::string& reference, const std::vector<double>& corners) {
  return reference.empty() ? kAnyWindow : corners.empty() ? kGuessedOpening : "";
}

/// Takes the reference from the file, unless options give one. \throws InputError
inline void takeReference(const std::string& file, const configuration::ReferenceParams& kept,
                          std::string& image, std::vector<double>& corners) {
  if (!kept.corners.empty() && kept.corners.size() != 8)
    throw InputError(file + ": window_detector/reference/corners: eight numbers");
  if (!image.empty()) return;
  image = kept.picture;
  corners = kept.corners;
}

/// Reads the detector's parameters and the reference's image and corners. \throws InputError
inline detection::DetectorParams readParams(const std::string& file, std::string& image,
                                            std::vector<double>& corners) {
  const configuration::Overlay overlay = configuration::readOverlay(file);
  takeReference(file, overlay.window_detector.reference, image, corners);
  return overlay.window_detector.detector;
}

/// Takes the opening's size from an option "W,H". \throws InputError
inline void takeWindowSize(const std::string& option, const std::string& text, estimation::PoseParams& pose) {
  const auto size = numbers(option, text, 2);
  pose.opening_width_m = size[0];
  pose.opening_height_m = size[1];
  const auto faults = parameters::outOfRange(pose);
  if (!faults.empty()) throw InputError(option + " " + text + ": " + parameters::joined(faults));
}

/// "1.2 x 1 m"
inline std::string sizeOf(const estimation::PoseParams& opening) {
  return formatted("%g x %g m", opening.opening_width_m, opening.opening_height_m);
}

/// Says that width and height look exchanged, or one of them misread; else empty. An oblique view differs by
/// less. \param in_image width over height of the opening in the reference image
inline std::string otherAspect(double in_image, const estimation::PoseParams& opening) {
  constexpr double kMaxRatio = 1.25;
  const double given = opening.opening_width_m / opening.opening_height_m;
  if (opening.scale_sigma > 0.0 || std::max(in_image / given, given / in_image) <= kMaxRatio) return "";
  return "the opening, " + sizeOf(opening) +
         formatted(
             ", is %.3g times as wide as it is high, but %.3g times in the reference image: measure both "
             "sides and check the corners",
             given, in_image);
}

/// Writes all detector values that differ from the defaults, so that the file replaces the one loaded before.
/// \return the yaml text written \throws InputError
inline std::string saveParams(const std::string& file, const std::string& about,
                              detection::DetectorParams params) {
  detection::DetectorParams defaults;
  const std::string overlay =
      parameters::toYaml(parameters::changed(parameters::fieldsOf(params), parameters::fieldsOf(defaults)),
                         "window_detector/detector");
  std::ofstream output(file);
  output << "# Written by " << about << "\n" << overlay;
  output.close();
  if (!output) throw InputError(file + ": cannot be written");
  return overlay;
}

}  // namespace window_ingress::tools
