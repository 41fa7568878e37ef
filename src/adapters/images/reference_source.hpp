/// Where the reference of the target comes from: a photograph, or the live image.
#pragma once

#include <window_ingress/ReferenceImage.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "adapters/images/image_conversion.hpp"
#include "window_ingress/configuration/detector_node_params.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/reference_appearance.hpp"

namespace window_ingress::adapters {

using configuration::ReferenceParams;

/// A reference from an image and the opening's corners: eight numbers, or none for the whole image. \throws
/// InputError
detection::ReferenceAppearance makeReference(const cv::Mat& image, const std::vector<double>& corners,
                                             const detection::DetectorParams& params);

/// A reference from a message, live or recorded. \throws InputError
detection::ReferenceAppearance makeReference(const window_ingress::ReferenceImage& message,
                                             const ImageLimits& limits,
                                             const detection::DetectorParams& params);

/// A reference from the operator's image file. \throws InputError that says what is wrong with the file
detection::ReferenceAppearance loadReference(const ReferenceParams& reference,
                                             const detection::DetectorParams& params);

/// Files of one reference, with the same stem: the image; a .yaml overlay for `config:=` with the parameters
/// that load it, below the node's name; and _understood.png, a drawing of the reference
/// (`detection::drawReference`).
struct ReferenceFiles {
  std::filesystem::path image, overlay, understood;  ///< absolute
  explicit ReferenceFiles(const std::string& file);
};

/// The file itself, or the first of FILE_2, FILE_3 .. for which no file of a reference exists.
std::string unusedReferenceFile(const std::string& file);

/// Writes all files of a reference. \throws InputError that names the file that could not be written
void saveReference(const std::string& file, const detection::ReferenceAppearance& reference);

}  // namespace window_ingress::adapters
