/// Reads parameter structs from yaml files.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::parameters {

/// Fills the fields from a yaml file. Missing keys keep their defaults.
/// \return paths of the keys in the file: "group/field"
/// \throws InputError with one line per fault, "file:line: key: what is wrong", in the order of the file:
/// unknown keys, wrong types, values out of range
std::set<std::string> readYamlFile(const std::string& file, const std::vector<Field>& fields);

template <typename Params>
std::set<std::string> readYamlFile(const std::string& file, Params& params) {
  return readYamlFile(file, fieldsOf(params));
}

}  // namespace window_ingress::parameters
