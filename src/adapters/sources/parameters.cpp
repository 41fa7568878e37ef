#include "adapters/sources/parameters.hpp"

#include <cmath>

namespace window_ingress::adapters {
namespace {

using XmlRpc::XmlRpcValue;

// XmlRpcValue reads by non-const conversion only.
template <typename Value>
Value as(const XmlRpcValue& value) {
  XmlRpcValue copy(value);
  return static_cast<Value>(copy);
}

bool isNumber(const XmlRpcValue& value) {
  return value.getType() == XmlRpcValue::TypeInt || value.getType() == XmlRpcValue::TypeDouble;
}

double number(const XmlRpcValue& value) {
  return value.getType() == XmlRpcValue::TypeInt ? as<int>(value) : as<double>(value);
}

const char* typeName(const XmlRpcValue& value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return "true or false";
    case XmlRpcValue::TypeInt:
      return "a whole number";
    case XmlRpcValue::TypeDouble:
      return "a number";
    case XmlRpcValue::TypeString:
      return "a text";
    case XmlRpcValue::TypeArray:
      return "a list";
    case XmlRpcValue::TypeStruct:
      return "a mapping";
    default:
      return "nothing";
  }
}

XmlRpcValue emptyStruct() {
  XmlRpcValue value;
  value.begin();  // makes it a struct
  return value;
}

}  // namespace

ParameterReader::ParameterReader(const std::string& name_space, const XmlRpcValue& tree,
                                 const std::vector<std::string>& known)
    : name_space_(name_space), known_(known), tree_(tree) {}

const XmlRpcValue* ParameterReader::find(const std::string& name) {
  asked_.insert(name);
  return tree_.hasMember(name) ? &tree_[name] : nullptr;
}

void ParameterReader::wrongType(const std::string& name, const char* expected, const XmlRpcValue& found) {
  faults_.push_back(name_space_ + "/" + name + " must be " + expected + ", not " + typeName(found));
}

void ParameterReader::checkRange(const std::string& name, double value, double minimum, double maximum) {
  parameters::RangeCheck check;
  check(name_space_ + "/" + name, value, minimum, maximum);
  faults_.insert(faults_.end(), check.faults().begin(), check.faults().end());
}

void ParameterReader::operator()(const std::string& name, double& value, double minimum, double maximum) {
  const XmlRpcValue* found = find(name);
  if (!found) return;
  if (!isNumber(*found)) return wrongType(name, "a number", *found);
  value = number(*found);
  checkRange(name, value, minimum, maximum);
}

void ParameterReader::operator()(const std::string& name, int& value, double minimum, double maximum) {
  const XmlRpcValue* found = find(name);
  if (!found) return;
  if (found->getType() != XmlRpcValue::TypeInt) return wrongType(name, "a whole number", *found);
  value = as<int>(*found);
  checkRange(name, value, minimum, maximum);
}

void ParameterReader::operator()(const std::string& name, bool& value) {
  const XmlRpcValue* found = find(name);
  if (!found) return;
  if (found->getType() != XmlRpcValue::TypeBoolean) return wrongType(name, "true or false", *found);
  value = as<bool>(*found);
}

void ParameterReader::operator()(const std::string& name, std::string& value) {
  const XmlRpcValue* found = find(name);
  if (!found) return;
  if (found->getType() != XmlRpcValue::TypeString) return wrongType(name, "a text", *found);
  value = as<std::string>(*found);
}

void ParameterReader::choice(const std::string& name, std::string& value,
                             const std::vector<std::string>& allowed) {
  (*this)(name, value);
  parameters::RangeCheck check;
  check.choice(name_space_ + "/" + name, value, allowed);
  faults_.insert(faults_.end(), check.faults().begin(), check.faults().end());
}

void ParameterReader::operator()(const std::string& name, std::vector<double>& value) {
  const XmlRpcValue* found = find(name);
  if (!found) return;
  if (found->getType() != XmlRpcValue::TypeArray) return wrongType(name, "a list of numbers", *found);
  std::vector<double> numbers;
  for (int i = 0; i < found->size(); ++i) {
    const XmlRpcValue& element = (*found)[i];
    if (!isNumber(element) || !std::isfinite(number(element)))
      return wrongType(name + "[" + std::to_string(i) + "]", "a finite number", element);
    numbers.push_back(number(element));
  }
  value = numbers;
}

ParameterReader ParameterReader::descend(const std::string& name) {
  const XmlRpcValue* found = find(name);
  if (found && found->getType() != XmlRpcValue::TypeStruct)
    wrongType(name, "a mapping of names to values", *found);
  const bool usable = found && found->getType() == XmlRpcValue::TypeStruct;
  ParameterReader child(name_space_ + "/" + name, usable ? *found : emptyStruct(), known_);
  child.path_ = path_ + name + "/";
  return child;
}

void ParameterReader::adopt(const ParameterReader& other) {
  const std::vector<std::string> faults = other.faults();
  faults_.insert(faults_.end(), faults.begin(), faults.end());
}

std::vector<std::string> ParameterReader::faults() const {
  std::vector<std::string> faults = faults_;
  XmlRpcValue tree(tree_);
  for (auto& member : tree)
    if (asked_.count(member.first) == 0)
      faults.push_back("unknown parameter " + name_space_ + "/" + member.first +
                       parameters::didYouMean(path_ + member.first, known_));
  return faults;
}

void ParameterReader::throwIfFaulty() const {
  const std::vector<std::string> all = faults();
  if (!all.empty()) throw InputError(parameters::joined(all));
}

XmlRpcValue parameterTree(const ros::NodeHandle& nh) {
  XmlRpcValue tree;
  if (!nh.getParam(nh.getNamespace(), tree)) return emptyStruct();
  if (tree.getType() != XmlRpcValue::TypeStruct)
    throw InputError(nh.getNamespace() + " is " + typeName(tree) +
                     ", must be a mapping of names to values: these parameters stand below it");
  return tree;
}

}  // namespace window_ingress::adapters
