/// The images that all measurements share, in a folder with lossless files and an index.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "window_ingress/detection/reference_appearance.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::bench {

/// Successive images of one camera in front of one target.
struct Sequence {
  std::string name;                ///< of the rows in the tables
  std::string kind;                ///< "rendering", "drawn", "recording" or "photograph"
  double period_sec = 1.0 / 30.0;  ///< between the images [s]
  std::vector<cv::Mat> images;     ///< CV_8UC3, BGR; at least one
  std::optional<geometry::PinholeCamera> camera;
  std::optional<detection::ReferenceAppearance> reference;

  const geometry::PinholeCamera* cameraOrNull() const { return camera ? &*camera : nullptr; }
};

/// Reads `folder`/frames.json: a list of {name, kind, period_sec, images: [files], camera: {width, height,
/// fx, fy, cx, cy, distortion: [5]} or null, reference: {image: file, corners: [8] or null} or null}.
/// \param wanted whether to read the sequence of that name
/// \throws std::runtime_error, one line "file: what is wrong"
std::vector<Sequence> readFrameSet(
    const std::string& folder,
    const std::function<bool(const std::string&)>& wanted = [](const std::string&) { return true; });

/// Adds one sequence to the index, creates the index if needed, and writes the images as PNG.
void addToFrameSet(const std::string& folder, const Sequence& sequence);

}  // namespace window_ingress::bench
