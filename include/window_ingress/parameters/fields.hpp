/// One list of fields per parameter struct, from which everything else is derived: range checks, reading from
/// yaml, reading from the ROS parameter server, the tables of the documentation.
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
/// `field(name, value, minimum, maximum)` for double and int, `field(name, value)` for bool and std::string,
/// `field.choice(name, text, {allowed, ...})` for one of a few words,
/// `field.group(name, params)` for a struct within,
/// `field.list(name, items)` for a std::vector of structs (range checks and scenario files only).
/// Names of nested fields are joined with '/', as ROS does.
#pragma once

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace window_ingress::parameters {

/// Collects one text for each field that is not finite or out of its range.
class RangeCheck {
 public:
  template <typename Number>
  void operator()(const std::string& name, const Number& value, double minimum, double maximum) {
    const double number = static_cast<double>(value);
    if (std::isfinite(number) && number >= minimum && number <= maximum) return;
    std::ostringstream text;
    text << prefix_ << name << " = " << value << " is not within " << minimum << " .. " << maximum;
    faults_.push_back(text.str());
  }
  template <typename Value>
  void operator()(const std::string&, const Value&) {}
  void choice(const std::string& name, const std::string& value, const std::vector<std::string>& allowed);
  template <typename Params>
  void group(const std::string& name, const Params& params) {
    const std::string outer = prefix_;
    prefix_ += name + "/";
    Params::visit(params, *this);
    prefix_ = outer;
  }
  template <typename Params>
  void list(const std::string& name, const std::vector<Params>& items) {
    for (std::size_t i = 0; i < items.size(); ++i) group(name + "[" + std::to_string(i) + "]", items[i]);
  }
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  std::string prefix_;
  std::vector<std::string> faults_;
};

/// All fields of `params` that are out of range, one text each; empty if there are none.
template <typename Params>
std::vector<std::string> outOfRange(const Params& params) {
  RangeCheck check;
  Params::visit(params, check);
  return check.faults();
}

/// The texts as one line, for an error.
std::string joined(const std::vector<std::string>& texts, const char* between = "; ");

}  // namespace window_ingress::parameters
