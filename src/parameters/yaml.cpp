#include "window_ingress/parameters/yaml.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <functional>
#include <ios>
#include <iterator>
#include <sstream>
#include <type_traits>

#include "parameters/yaml_nodes.hpp"

namespace window_ingress::parameters {
namespace {

constexpr char kSecondTime[] = ": is given twice";

// Whether ROS reads a value that is not a text here in the same way: in quotes, and as "1e-3", "-.5" or "y",
// ROS reads a text, and "010" as eight.
bool isPlainForRos(const YAML::Node& node) {
  if (node.IsSequence()) return std::all_of(node.begin(), node.end(), isPlainForRos);
  const std::string& text = node.Scalar();
  if (node.Tag() == "!" || text.find_first_not_of("yYnN") == std::string::npos) return false;
  if (text.find_first_of("0123456789") == std::string::npos) return true;
  const auto first = text.find_first_not_of("+-");
  const auto exponent = text.find_first_of("eE");
  const bool is_octal = text[first] == '0' && first + 1 < text.size() && std::isdigit(text[first + 1]) != 0;
  const bool is_text = exponent != std::string::npos &&
                       (text.find('.') > exponent || text.find_first_of("+-", exponent) != exponent + 1);
  return !is_octal && !is_text && (first == 0 || text[first] != '.');
}

// The value found, for people.
std::string found(const YAML::Node& node) {
  if (node.IsScalar()) return "'" + node.Scalar() + "'";
  return node.IsSequence() ? "a list" : node.IsMap() ? "a mapping" : "empty";
}

bool isIndentedByTabs(const std::string& file) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (line.find('\t') < line.find_first_not_of(" \t")) return true;
  return false;
}

// yaml-cpp reads UTF-16 and UTF-32, roslaunch does not. Their ASCII letters contain zeros.
bool holdsZeros(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return std::find(std::istreambuf_iterator<char>(stream), {}, '\0') != std::istreambuf_iterator<char>();
}

bool isNumber(const YAML::Node& word) {
  double number = 0.0;
  return YAML::convert<double>::decode(word, number);
}

}  // namespace

YAML::Node loadYaml(const std::string& file) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAllFromFile(file);
    if (holdsZeros(file)) throw InputError(file + ": is not plain text; save it as UTF-8");
    if (documents.size() > 1)
      throw InputError(file + ": holds " + std::to_string(documents.size()) +
                       " documents instead of one: a line '---' or a name without its colon separates them");
    return documents.empty() ? YAML::Node() : documents.front();
  } catch (const YAML::BadFile&) {
    throw InputError(file + ": cannot be read; does it exist?");
  } catch (const std::ios_base::failure&) {
    throw InputError(file + ": cannot be read; a folder?");
  } catch (const YAML::Exception& error) {
    throw InputError(file + ":" + std::to_string(error.mark.line + 1) + ": not valid yaml: " + error.msg +
                     (isIndentedByTabs(file) ? "; indent with blanks, yaml does not allow tabs" : ""));
  }
}

YamlFault faultAt(const std::string& file, const YAML::Node& at, const std::string& text) {
  const int line = std::max(0, at.Mark().line) + 1;
  return {line, file + ":" + std::to_string(line) + ": " + text};
}

void YamlFaults::throwIfAny() const {
  std::vector<std::string> lines;
  for (const auto& [line, fault] : by_line_) lines.push_back(fault);
  if (!lines.empty()) throw InputError(joined(lines, "\n"));
}

std::vector<YamlEntry> entriesOf(const std::string& file, const YAML::Node& mapping, const std::string& path,
                                 YamlFaults& faults) {
  const std::string place = path.empty() ? "" : path.substr(0, path.size() - 1) + ": ";
  std::vector<YamlEntry> entries;
  std::set<std::string> names;
  if (!mapping.IsMap()) {
    faults.add(faultAt(file, mapping, place + "must be a mapping of keys to values, not " + found(mapping)));
    return entries;
  }
  for (const auto& entry : mapping) {
    const YAML::Node key = entry.first, value = entry.second;
    const std::string name = key.IsScalar() ? key.Scalar() : "";
    if (!key.IsScalar())
      faults.add(faultAt(file, key, place + "a key must be a word"));
    else if (!names.insert(name).second)
      faults.add(faultAt(file, key, path + name + kSecondTime));
    else if (value.IsNull())  // an empty value has the mark of the next entry
      faults.add(
          faultAt(file, key,
                  path + name +
                      (isNumber(key) ? ": is a number without a key: a comma in place of a decimal point?"
                                     : ": is empty; give it a value, or leave it out")));
    else
      entries.push_back({name, key, value});
  }
  return entries;
}

void readValue(const std::string& file, const YAML::Node& node, const Field& field) {
  const auto read = [&](auto* value) {
    const auto before = *value;
    try {
      *value = node.as<std::decay_t<decltype(*value)>>();
    } catch (const YAML::Exception&) {
      throw faultAt(file, node, field.name + ": must be " + kindOf(field) + ", not " + found(node));
    }
    std::string fault = faultOf(field);
    if (!std::is_same_v<std::decay_t<decltype(*value)>, std::string> && !isPlainForRos(node))
      fault = field.name + ": must be " + kindOf(field) +
              "; ROS reads this differently: no quotes, no leading zeros, 1.0e-3 instead of 1e-3, -0.5 "
              "instead of -.5";
    if (fault.empty()) return;
    *value = before;
    throw faultAt(file, node, fault);
  };
  std::visit(read, field.value);
}

std::set<std::string> readYamlFile(const std::string& file, const std::vector<Field>& fields) {
  const std::vector<std::string> keys = keysOf(fields);
  std::set<std::string> said;
  YamlFaults faults;
  const std::function<void(const YAML::Node&, const std::string&)> read = [&](const auto& mapping,
                                                                              const auto& path) {
    for (const YamlEntry& entry : entriesOf(file, mapping, path, faults)) {
      const std::string here = path + entry.name;
      if (const Field* field = find(fields, here))
        faults.collect([&] {
          if (!said.insert(here).second) throw faultAt(file, entry.key, here + kSecondTime);
          readValue(file, entry.value, *field);
        });
      else if (std::find(keys.begin(), keys.end(), here) != keys.end())
        read(entry.value, here + "/");
      else
        faults.add(faultAt(file, entry.key, here + ": unknown key" + didYouMean(here, keys)));
    }
  };
  read(loadYaml(file), "");
  faults.throwIfAny();
  return said;
}

std::string toYaml(const std::vector<Field>& fields, const std::string& path) {
  YAML::Node root(YAML::NodeType::Map);
  const auto at = [&root](const std::string& whole) {
    YAML::Node node = root;
    std::istringstream parts(whole);
    for (std::string part; std::getline(parts, part, '/');) node.reset(node[part]);
    return node;
  };
  if (fields.empty()) at(path) = YAML::Load("{}");
  for (const Field& field : fields) at(path + "/" + field.name) = toText(field);
  return YAML::Dump(root) + "\n";
}

}  // namespace window_ingress::parameters
