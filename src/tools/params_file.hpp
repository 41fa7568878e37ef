/// What the file behind --params holds: thresholds in its section 'detector', the operator's reference in
/// 'reference', as make_reference and ~capture_reference write it.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "command_line.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/parameters/yaml.hpp"
#include "window_ingress/parameters/yaml_mapping.hpp"

namespace window_ingress::tools {

// At the top of the file, or below the name of a node.
inline YAML::Node referenceIn(const YAML::Node& root) {
  if (!root.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
  if (const YAML::Node found = root["reference"]; found.IsDefined()) return found;
  for (const auto& node : root) {
    if (!node.second.IsMap()) continue;
    const YAML::Node& below = node.second;
    if (const YAML::Node found = below["reference"]; found.IsDefined()) return found;
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

/// Fills `picture` and `corners` from the section 'reference'. \return whether there is one \throws
/// UsageError
inline bool readReferenceSection(const std::string& file, std::string& picture,
                                 std::vector<double>& corners) {
  const YAML::Node found = referenceIn(parameters::loadYaml(file));
  if (!found.IsDefined()) return false;
  try {
    picture = found["picture"].as<std::string>();
    corners = found["corners"].as<std::vector<double>>(std::vector<double>());
  } catch (const YAML::Exception&) {
    throw UsageError(file + ": reference: needs 'picture', a file, and 'corners', eight numbers");
  }
  if (!corners.empty() && corners.size() != 8) throw UsageError(file + ": reference/corners: eight numbers");
  return true;
}

/// Reads both; a reference that was given by its own options stays. \throws UsageError, YamlError
inline void readParams(const std::string& file, detection::DetectorParams& params, std::string& picture,
                       std::vector<double>& corners) {
  if (file.empty()) return;
  const bool thresholds = parameters::readYamlFile(file, "detector", params);
  std::string kept_picture;
  std::vector<double> kept_corners;
  const bool reference = readReferenceSection(file, kept_picture, kept_corners);
  if (!thresholds && !reference)
    throw UsageError(file + ": no section 'detector' or 'reference' in this file");
  if (!reference || !picture.empty()) return;
  picture = kept_picture;
  corners = kept_corners;
}

}  // namespace window_ingress::tools
