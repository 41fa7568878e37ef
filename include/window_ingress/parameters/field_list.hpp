#pragma once

#include <functional>
#include <string>
#include <vector>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::parameters {

/// A number or a switch of a parameter struct, by its whole name ("edges/floor"). A switch is 0 or 1.
struct NamedField {
  enum Kind { kNumber, kWhole, kSwitch };
  std::string name;
  Kind kind = kNumber;
  double minimum = 0.0, maximum = 1.0;
  std::function<double()> get;      ///< refers to the struct the list was made of
  std::function<void(double)> set;  ///< the nearest value that the field can hold; NaN changes nothing
};

/// Visitor that lists them; texts and lists are left out.
class FieldLister {
 public:
  void operator()(const std::string& name, double& value, double minimum, double maximum) {
    add(name, NamedField::kNumber, value, minimum, maximum);
  }
  void operator()(const std::string& name, int& value, double minimum, double maximum) {
    add(name, NamedField::kWhole, value, minimum, maximum);
  }
  void operator()(const std::string& name, bool& value) { add(name, NamedField::kSwitch, value, 0.0, 1.0); }
  template <typename Value>
  void operator()(const std::string&, Value&) {}
  void choice(const std::string&, std::string&, const std::vector<std::string>&) {}
  template <typename Params>
  void group(const std::string& name, Params& params) {
    const std::string outer = prefix_;
    prefix_ += name + "/";
    Params::visit(params, *this);
    prefix_ = outer;
  }
  std::vector<NamedField> fields;

 private:
  template <typename Value>
  void add(const std::string& name, NamedField::Kind kind, Value& value, double minimum, double maximum) {
    fields.push_back({prefix_ + name, kind, minimum, maximum, [&value] { return static_cast<double>(value); },
                      [&value, kind, minimum, maximum](double wanted) {
                        value = static_cast<Value>(
                            nearest(wanted, static_cast<double>(value), kind, minimum, maximum));
                      }});
  }
  static double nearest(double wanted, double before, NamedField::Kind kind, double minimum, double maximum);
  std::string prefix_;
};

/// All numbers and switches of `params`, which must outlive the list.
template <typename Params>
std::vector<NamedField> fieldsOf(Params& params) {
  FieldLister lister;
  Params::visit(params, lister);
  return lister.fields;
}

/// The field of this name, or null.
const NamedField* find(const std::vector<NamedField>& fields, const std::string& name);

/// The value as yaml has it: true or false, whole numbers without a point, others so that they read back the
/// same.
std::string toText(const NamedField& field);

/// Sets a field from "name=value". \throws std::invalid_argument, one line: unknown name, no number, out of
/// range
void assign(const std::vector<NamedField>& fields, const std::string& assignment);

/// Those fields whose value differs from that of the same name in `before`.
std::vector<NamedField> changed(const std::vector<NamedField>& fields, const std::vector<NamedField>& before);

/// As nested yaml mappings below `path` ("window_detector/detector"), with an empty mapping for no fields.
std::string toYaml(const std::vector<NamedField>& fields, const std::string& path);

}  // namespace window_ingress::parameters
