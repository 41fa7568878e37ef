/// Numbers and switches of a parameter struct as text, for whoever tunes them.
#pragma once

#include <string>
#include <vector>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::parameters {

/// The value as yaml has it: true or false, whole numbers without a point, others so that they read back the
/// same.
std::string toText(const Field& field);

/// Sets a number or switch from "name=value". \throws InputError, one line: unknown name, no number, out of
/// range
void assign(const std::vector<Field>& fields, const std::string& assignment);

/// Those fields whose value differs from that of the same name in `before`.
std::vector<Field> changed(const std::vector<Field>& fields, const std::vector<Field>& before);

/// As nested yaml mappings below `path` ("window_detector/detector"), with an empty mapping for no fields.
std::string toYaml(const std::vector<Field>& fields, const std::string& path);

}  // namespace window_ingress::parameters
