/// One list of fields per parameter struct serves all uses: range checks, reading from yaml and from the ROS
/// parameter server, dynamic_reconfigure, trackbars and the tables of the documentation.
///
/// A parameter struct lists its fields once:
///
///     struct CannyParams {
///       double low = 40.0;  ///< hysteresis: lower threshold [grey levels a pixel]
///       template <typename Self, typename Visitor>
///       static void visit(Self& self, Visitor&& field) {
///         field("low", self.low, 0.0, 255.0);
///       }
///     };
///
/// `field(name, value, minimum, maximum)` for double and int, `field(name, value)` for bool, std::string and
/// lists of numbers, `field.choice(name, text, {allowed, ...})` for one of a few words, `field.group(name,
/// params)` for a nested struct, `field.list(name, items)` for a std::vector of structs (range checks and
/// scenario files only). Names of nested fields are joined with '/', as ROS does.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace window_ingress::parameters {

/// One field of a parameter struct.
struct Field {
  std::string name;  ///< full path: "edges/floor"
  std::variant<double*, int*, bool*, std::string*, std::vector<double>*>
      value;                              ///< points into the listed struct
  double minimum = 0.0, maximum = 1.0;    ///< limits of a number, both included
  std::vector<std::string> allowed = {};  ///< words that a text may be; empty: any

  bool isWhole() const { return std::holds_alternative<int*>(value); }
  bool isSwitch() const { return std::holds_alternative<bool*>(value); }
  /// The number; 0 or 1 for a switch; 0 for any other kind.
  double get() const;
  void set(double wanted) const;  ///< sets the nearest allowed value; NaN changes nothing
};

/// Visitor that lists the fields.
class FieldLister {
 public:
  template <typename Number>
  void operator()(const std::string& name, Number& value, double minimum, double maximum) {
    fields.push_back({prefix_ + name, &value, minimum, maximum});
  }
  template <typename Value>
  void operator()(const std::string& name, Value& value) {
    fields.push_back({prefix_ + name, &value});
  }
  void choice(const std::string& name, std::string& word, const std::vector<std::string>& allowed) {
    fields.push_back({prefix_ + name, &word, 0.0, 1.0, allowed});
  }
  template <typename Params>
  void group(const std::string& name, Params& params) {
    const std::string outer = prefix_;
    prefix_ += name + "/";
    Params::visit(params, *this);
    prefix_ = outer;
  }
  template <typename Params>
  void list(const std::string& name, std::vector<Params>& items) {
    for (std::size_t i = 0; i < items.size(); ++i) group(name + "[" + std::to_string(i) + "]", items[i]);
  }
  std::vector<Field> fields;

 private:
  std::string prefix_;
};

/// All fields of `params`, which must outlive the list.
template <typename Params>
std::vector<Field> fieldsOf(Params& params) {
  FieldLister lister;
  Params::visit(params, lister);
  return lister.fields;
}

/// The paths of all fields, each group before its contents: "vehicle", "vehicle/half_width_m".
std::vector<std::string> keysOf(const std::vector<Field>& fields);

/// Text after "unknown key": "; did you mean 'vehicle: {half_width_m: ..}'?". If no known key is similar, the
/// text lists the keys that could stand there, if they are few; otherwise it is empty.
/// \param path the unknown key
/// \param known all known keys
std::string didYouMean(const std::string& path, const std::vector<std::string>& known);

/// The field of this name, or null.
const Field* find(const std::vector<Field>& fields, const std::string& name);

/// Kind of its value, for people: "a number", "true or false".
const char* kindOf(const Field& field);

/// Why the field's value is invalid: "NAME = VALUE is not within ..". Empty if it is valid.
std::string faultOf(const Field& field);
std::vector<std::string> faultsOf(const std::vector<Field>& fields);  ///< of all invalid fields

/// All fields of `params` that are out of range, one text each; empty if there are none.
template <typename Params>
std::vector<std::string> outOfRange(Params params) {
  return faultsOf(fieldsOf(params));
}

/// The texts as one line, for an error.
std::string joined(const std::vector<std::string>& texts, const char* between = "; ");

/// \throws std::invalid_argument "OWNER: FAULT; FAULT", one line, if there is any fault
void throwIfAny(const std::vector<std::string>& faults, const std::string& owner);

/// `params`, all of whose fields are in range. \throws std::invalid_argument, as `throwIfAny`
template <typename Params>
Params requireInRange(const Params& params, const std::string& owner) {
  throwIfAny(outOfRange(params), owner);
  return params;
}

/// The value in yaml: true or false, integers without a point, other numbers so that they read back the same.
std::string toText(const Field& field);

/// Sets a number or switch from "name=value". \throws InputError, one line: unknown name, no number, out of
/// range
void assign(const std::vector<Field>& fields, const std::string& assignment);

/// The fields whose values differ from those of the same name in `before`.
std::vector<Field> changed(const std::vector<Field>& fields, const std::vector<Field>& before);

/// The fields as nested yaml mappings below `path` ("window_detector/detector"); an empty mapping for no
/// fields.
std::string toYaml(const std::vector<Field>& fields, const std::string& path);

}  // namespace window_ingress::parameters
