#include "window_ingress/parameters/key_list.hpp"

#include <algorithm>
#include <utility>

#include "parameters/former_keys.hpp"

namespace window_ingress::parameters {
namespace {

std::string groupOf(const std::string& path) {
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string nameOf(const std::string& path) { return path.substr(path.rfind('/') + 1); }

// Letters to insert, remove or exchange, neighbours that have changed places counting once (optimal string
// alignment).
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> to(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) to[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) to[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t exchanged = to[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      to[i][j] = std::min({to[i - 1][j] + 1, to[i][j - 1] + 1, exchanged});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) to[i][j] = std::min(to[i][j], to[i - 2][j - 2] + 1);
    }
  return to[a.size()][b.size()];
}

// As it stands in a file: "a/b/c" is "a: {b: {c: ..}}".
std::string inYaml(const std::string& path) {
  const auto slash = path.find('/');
  if (slash == std::string::npos) return path + ": ..";
  return path.substr(0, slash) + ": {" + inYaml(path.substr(slash + 1)) + "}";
}

// A name without its unit is as good as one with a letter wrong.
std::size_t nameDistance(const std::string& name, const std::string& known) {
  return known.compare(0, name.size() + 1, name + "_") == 0 ? 1 : distance(name, known);
}

// How far a known path is from the one that is not: first by its name, then by where it stands.
std::pair<std::size_t, std::size_t> unlikeness(const std::string& path, const std::string& known) {
  return {nameDistance(nameOf(path), nameOf(known)), distance(groupOf(path), groupOf(known))};
}

// The few keys that could stand beside it; nothing where there are many.
std::string neighboursOf(const std::string& path, const std::vector<std::string>& known) {
  constexpr std::size_t kFew = 16;
  const std::string group = path.substr(0, path.size() - nameOf(path).size());
  std::vector<std::string> names;
  std::string listed;
  for (const auto& key : known) {
    if (key.compare(0, group.size(), group) != 0) continue;
    const std::string name = key.substr(group.size(), key.find('/', group.size()) - group.size());
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    listed += (names.empty() ? "; there is " : ", ") + name;
    names.push_back(name);
  }
  return names.size() > kFew ? "" : listed;
}

// All keys of that name, of the node that the path begins with if it has any: which of them is meant nobody
// knows.
std::vector<std::string> namesakesOf(const std::string& nearest, const std::string& path,
                                     const std::vector<std::string>& known) {
  const std::string node = path.substr(0, path.find('/') + 1);
  const bool within = nearest.compare(0, node.size(), node) == 0;
  std::vector<std::string> namesakes;
  for (const auto& key : known)
    if (nameOf(key) == nameOf(nearest) && (!within || key.compare(0, node.size(), node) == 0))
      namesakes.push_back(key);
  return namesakes;
}

}  // namespace

std::vector<std::string> keysOf(const std::vector<Field>& fields) {
  std::vector<std::string> keys;
  for (const Field& field : fields) {
    for (auto end = field.name.find('/'); end != std::string::npos; end = field.name.find('/', end + 1)) {
      const std::string group = field.name.substr(0, end);
      if (std::find(keys.begin(), keys.end(), group) == keys.end()) keys.push_back(group);
    }
    keys.push_back(field.name);
  }
  return keys;
}

std::string didYouMean(const std::string& path, const std::vector<std::string>& known) {
  if (const std::string now = whatBecameOf(path); !now.empty()) return now;
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return unlikeness(path, a) < unlikeness(path, b);
  });
  if (nearest == known.end() || 3 * unlikeness(path, *nearest).first > nameOf(path).size())
    return neighboursOf(path, known);
  if (groupOf(path) == groupOf(*nearest)) return "; did you mean '" + nameOf(*nearest) + "'?";
  std::string meant;
  for (const auto& key : namesakesOf(*nearest, path, known))
    meant += (meant.empty() ? "'" : " or '") + inYaml(key) + "'";
  return "; did you mean " + meant + "?";
}

}  // namespace window_ingress::parameters
