/// Fuzz targets for the package's inputs. Each accepts any bytes, and must neither crash nor break its
/// promises. Run by libFuzzer (`dev/fuzz`); the program `faults` runs them on the kept inputs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace window_ingress::fuzz {

using Target = void(const std::uint8_t* data, std::size_t size);

Target image;        ///< raw and compressed images of any encoding, size and step: guard
Target detection;    ///< small images that the guard accepts: guard, detector, tracker
Target camera_info;  ///< any calibration: conversion, projection
Target corners;      ///< any detection message: conversion, pose, filter
Target scenario;     ///< scenario files
Target parameters;   ///< parameter and calibration files; accepted ones must work
Target bag;          ///< bag files: opening, choosing topics, replay

/// Reports a broken promise. The fuzzer ends here, as at a crash.
inline void require(bool holds, const std::string& what) {
  if (!holds) throw std::logic_error(what);
}

}  // namespace window_ingress::fuzz
