#include "adapters/runtime/parameter_server.hpp"

#include <algorithm>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::adapters {
namespace {

using parameters::Field;
using XmlRpc::XmlRpcValue;

// Conversions of XmlRpcValue are not const.
std::string kindOf(XmlRpcValue& value);

bool take(XmlRpcValue& from, double& value) {
  const bool is_whole = from.getType() == XmlRpcValue::TypeInt;
  if (!is_whole && from.getType() != XmlRpcValue::TypeDouble) return false;
  value = is_whole ? static_cast<int&>(from) : static_cast<double&>(from);
  return true;
}
template <typename Value>
bool takeIf(XmlRpcValue::Type type, XmlRpcValue& from, Value& value) {
  if (from.getType() != type) return false;
  value = static_cast<Value&>(from);
  return true;
}
bool take(XmlRpcValue& from, int& value) { return takeIf(XmlRpcValue::TypeInt, from, value); }
bool take(XmlRpcValue& from, bool& value) { return takeIf(XmlRpcValue::TypeBoolean, from, value); }
bool take(XmlRpcValue& from, std::string& value) { return takeIf(XmlRpcValue::TypeString, from, value); }
bool take(XmlRpcValue& from, std::vector<double>& value) {
  if (from.getType() != XmlRpcValue::TypeArray) return false;
  value.resize(static_cast<std::size_t>(from.size()));
  for (int i = 0; i < from.size(); ++i)
    if (!take(from[i], value[static_cast<std::size_t>(i)])) return false;
  return true;
}

std::string kindOf(XmlRpcValue& value) {
  double number = 0.0;
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return "true or false";
    case XmlRpcValue::TypeInt:
      return "a whole number";
    case XmlRpcValue::TypeDouble:
      return "a number";
    case XmlRpcValue::TypeString:
      return "a text";
    case XmlRpcValue::TypeStruct:
      return "a mapping";
    case XmlRpcValue::TypeArray:
      for (int i = 0; i < value.size(); ++i)
        if (!take(value[i], number)) return "a list with " + kindOf(value[i]) + " in it";
      return "a list";
    default:
      return "nothing";
  }
}

/// Walks over a tree of parameters and knows the permitted names.
class TreeReader {
 public:
  TreeReader(const std::string& name_space, const std::vector<Field>& fields)
      : name_space_(name_space), fields_(fields), keys_(parameters::keysOf(fields)) {}

  void read(XmlRpcValue& tree, const std::string& path, const std::set<std::string>& others) {
    for (auto& [name, value] : tree) {
      const std::string key = path + name;
      if (others.count(key) > 0) continue;
      if (const Field* field = parameters::find(fields_, key))
        readField(value, *field);
      else if (std::find(keys_.begin(), keys_.end(), key) == keys_.end())
        faults.push_back("unknown parameter " + name_space_ + "/" + key + parameters::didYouMean(key, keys_));
      else if (value.getType() == XmlRpcValue::TypeStruct)
        read(value, key + "/", others);
      else
        mustBe("a mapping of names to values", key, value);
    }
  }

  std::vector<std::string> faults;

 private:
  void mustBe(const std::string& kind, const std::string& key, XmlRpcValue& value) {
    faults.push_back(name_space_ + "/" + key + " must be " + kind + ", not " + kindOf(value));
  }
  void readField(XmlRpcValue& value, const Field& field) {
    if (!std::visit([&](auto* at) { return take(value, *at); }, field.value))
      return mustBe(parameters::kindOf(field), field.name, value);
    if (const std::string fault = faultOf(field); !fault.empty()) faults.push_back(name_space_ + "/" + fault);
  }

  const std::string& name_space_;
  const std::vector<Field>& fields_;
  std::vector<std::string> keys_;
};

}  // namespace

std::vector<std::string> readTree(const std::string& name_space, XmlRpcValue tree,
                                  const std::vector<Field>& fields, const std::set<std::string>& others) {
  TreeReader reader(name_space, fields);
  reader.read(tree, "", others);
  return reader.faults;
}

std::vector<std::string> readFields(const ros::NodeHandle& nh, const std::vector<Field>& fields,
                                    const std::set<std::string>& others) {
  XmlRpcValue tree;
  if (!nh.getParam(nh.getNamespace(), tree)) return {};
  if (tree.getType() != XmlRpcValue::TypeStruct)
    throw InputError(nh.getNamespace() + " is " + kindOf(tree) +
                     ", must be a mapping of names to values: the node's parameters are below it");
  return readTree(nh.getNamespace(), tree, fields, others);
}

void refuseFaulty(const std::vector<std::string>& faults) {
  if (!faults.empty()) throw InputError(parameters::joined(faults));
}

}  // namespace window_ingress::adapters
