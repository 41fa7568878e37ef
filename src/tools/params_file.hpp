/// What the file behind --params holds for tools that look at images.
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"
#include "window_ingress/configuration/overlay.hpp"

namespace window_ingress::tools {

/// Of a reference that has no corners.
constexpr const char* kGuessedOpening =
    "the opening in the reference image is guessed, often wrongly: give its corners; 'ingress reference' "
    "finds and writes them";

/// The reference of the file, unless one was given by its own options. \throws InputError
inline void takeReference(const std::string& file, const configuration::ReferenceParams& kept,
                          std::string& image, std::vector<double>& corners) {
  if (!kept.corners.empty() && kept.corners.size() != 8)
    throw InputError(file + ": window_detector/reference/corners: eight numbers");
  if (!image.empty()) return;
  image = kept.picture;
  corners = kept.corners;
}

/// The detector's parameters; image and corners of the reference, too. \throws InputError, InputError
inline detection::DetectorParams readParams(const std::string& file, std::string& image,
                                            std::vector<double>& corners) {
  const configuration::Overlay overlay = configuration::readOverlay(file);
  takeReference(file, overlay.window_detector.reference, image, corners);
  return overlay.window_detector.detector;
}

}  // namespace window_ingress::tools
