/// The keys that somebody reads, and what was meant by one that nobody does.
#pragma once

#include <string>
#include <vector>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::parameters {

/// The paths of all fields, each group before what lies in it: "vehicle", "vehicle/half_width_m".
std::vector<std::string> keysOf(const std::vector<Field>& fields);

/// "speeed_mps: unknown key; did you mean 'speed_mps'?"
/// \param shown where it stands, for people
/// \param path that nobody reads
/// \param known all that somebody reads
std::string unknownKey(const std::string& shown, const std::string& path,
                       const std::vector<std::string>& known);

/// What to say behind "unknown key": "; did you mean 'vehicle: {half_width_m: ..}'?", or where
/// nothing is like it the few keys that could stand there, or nothing.
/// \param path that nobody reads
/// \param known all that somebody reads
std::string didYouMean(const std::string& path, const std::vector<std::string>& known);

}  // namespace window_ingress::parameters
