/// Known keys, and suggestions for an unknown one.
#pragma once

#include <string>
#include <vector>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::parameters {

/// The paths of all fields, each group before its contents: "vehicle", "vehicle/half_width_m".
std::vector<std::string> keysOf(const std::vector<Field>& fields);

/// "speeed_mps: unknown key; did you mean 'speed_mps'?"
/// \param shown place of the key, for people
/// \param path the unknown key
/// \param known all known keys
std::string unknownKey(const std::string& shown, const std::string& path,
                       const std::vector<std::string>& known);

/// Text after "unknown key": "; did you mean 'vehicle: {half_width_m: ..}'?". If no known key is similar, the
/// text lists the keys that could stand there, if they are few; otherwise it is empty.
/// \param path the unknown key
/// \param known all known keys
std::string didYouMean(const std::string& path, const std::vector<std::string>& known);

}  // namespace window_ingress::parameters
