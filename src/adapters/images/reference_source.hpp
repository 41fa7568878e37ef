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

/// A reference from an image and eight numbers, or none for the whole image. \throws InputError
detection::ReferenceAppearance makeReference(const cv::Mat& image, const std::vector<double>& corners,
                                             const detection::DetectorParams& params);

/// The same from a message, live or recorded. \throws InputError
detection::ReferenceAppearance makeReference(const window_ingress::ReferenceImage& message,
                                             const ImageLimits& limits,
                                             const detection::DetectorParams& params);

/// Reads the operator's image. \throws InputError that says what is wrong with it
detection::ReferenceAppearance loadReference(const ReferenceParams& reference,
                                             const detection::DetectorParams& params);

/// Of one reference: the image; beside it, of the same name, one that ends in .yaml with the parameters that
/// load it, below the node's name, so that it can be laid over the defaults as `config:=`; and one that ends
/// in _understood.png, what is made of it (`detection::drawReference`).
struct ReferenceFiles {
  std::filesystem::path image, overlay, understood;  ///< absolute
  explicit ReferenceFiles(const std::string& file);
};

/// The file itself, or, where one of a reference's is there already, the first of FILE_2, FILE_3 .. without
/// any.
std::string unusedReferenceFile(const std::string& file);

/// Writes all of them. \throws InputError that says which could not be written
void saveReference(const std::string& file, const detection::ReferenceAppearance& reference);

}  // namespace window_ingress::adapters
