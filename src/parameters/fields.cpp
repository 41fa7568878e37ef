#include "window_ingress/parameters/fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "window_ingress/text/text.hpp"

namespace window_ingress::parameters {
namespace {

bool isFinite(double number) { return std::isfinite(number); }

template <typename Number>
std::string rangeFault(const Field& field, Number value) {
  if (isFinite(value) && value >= field.minimum && value <= field.maximum) return "";
  std::ostringstream text;
  text << field.name << " = " << value << " is not within " << field.minimum << " .. " << field.maximum;
  return text.str();
}

std::string wordFault(const Field& field, const std::string& word) {
  const auto& allowed = field.allowed;
  const bool is_one = std::find(allowed.begin(), allowed.end(), word) != allowed.end();
  return allowed.empty() || is_one ? ""
                                   : field.name + " = " + word + " is not one of " + joined(allowed, ", ");
}

// The fewest digits that read back as the same number, with a point: without one, ROS takes it for an int,
// and "1e-05" for a text.
std::string shortest(double value) {
  std::string text;
  for (int digits = 1; digits <= 17; ++digits) {
    std::ostringstream stream;
    stream << std::setprecision(digits) << value;
    text = stream.str();
    if (std::strtod(text.c_str(), nullptr) == value) break;
  }
  if (text.find('.') != std::string::npos) return text;
  return text.insert(std::min(text.find('e'), text.size()), ".0");
}

double number(const std::string& name, const std::string& text) {
  if (text == "true") return 1.0;
  if (text == "false") return 0.0;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    throw InputError(name + ": '" + text + "' is not a number");
  return value;
}

}  // namespace

double Field::get() const {
  return std::visit(
      [](const auto* at) {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(*at)>>) return static_cast<double>(*at);
        return 0.0;
      },
      value);
}

void Field::set(double wanted) const {
  if (std::isnan(wanted)) return;
  const double inside = std::clamp(wanted, minimum, maximum);
  if (auto* const* number = std::get_if<double*>(&value)) **number = inside;
  if (auto* const* whole = std::get_if<int*>(&value)) **whole = static_cast<int>(std::lround(inside));
  if (auto* const* is_on = std::get_if<bool*>(&value)) **is_on = std::lround(inside) != 0;
}

const Field* find(const std::vector<Field>& fields, const std::string& name) {
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const Field& field) { return field.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

const char* kindOf(const Field& field) {
  constexpr const char* kKinds[] = {"a number", "a whole number", "true or false", "a text",
                                    "a list of numbers"};
  return kKinds[field.value.index()];
}

std::string faultOf(const Field& field) {
  if (auto* const* number = std::get_if<double*>(&field.value)) return rangeFault(field, **number);
  if (auto* const* whole = std::get_if<int*>(&field.value)) return rangeFault(field, **whole);
  if (auto* const* word = std::get_if<std::string*>(&field.value)) return wordFault(field, **word);
  if (auto* const* list = std::get_if<std::vector<double>*>(&field.value))
    return std::all_of((*list)->begin(), (*list)->end(), isFinite) ? ""
                                                                   : field.name + ": must be finite numbers";
  return "";
}

std::vector<std::string> faultsOf(const std::vector<Field>& fields) {
  std::vector<std::string> faults;
  for (const Field& field : fields)
    if (std::string fault = faultOf(field); !fault.empty()) faults.push_back(std::move(fault));
  return faults;
}

std::string joined(const std::vector<std::string>& texts, const char* between) {
  std::string line;
  for (const auto& text : texts) line += (line.empty() ? "" : between) + text;
  return line;
}

void throwIfAny(const std::vector<std::string>& faults, const std::string& owner) {
  if (!faults.empty()) throw std::invalid_argument(owner + ": " + joined(faults));
}

std::string toText(const Field& field) {
  if (field.isSwitch()) return field.get() != 0.0 ? "true" : "false";
  return field.isWhole() ? std::to_string(std::lround(field.get())) : shortest(field.get());
}

void assign(const std::vector<Field>& fields, const std::string& assignment) {
  const std::size_t sign = assignment.find('=');
  const std::string name = assignment.substr(0, sign);
  const Field* field = find(fields, name);
  if (sign == std::string::npos)
    throw InputError("'" + assignment + "': needs NAME=VALUE with the name of a number, like " +
                     (fields.empty() ? "none" : fields.front().name));
  if (!field) throw InputError(name + ": unknown name" + didYouMean(name, keysOf(fields)));
  double value = number(name, assignment.substr(sign + 1));
  const std::string fault = faultOf({name, &value, field->minimum, field->maximum});
  if (!fault.empty()) throw InputError(fault);
  field->set(value);
}

std::vector<Field> changed(const std::vector<Field>& fields, const std::vector<Field>& before) {
  std::vector<Field> result;
  for (const Field& field : fields) {
    const Field* old = find(before, field.name);
    if (old && old->get() != field.get()) result.push_back(field);
  }
  return result;
}

}  // namespace window_ingress::parameters
