#include <algorithm>
#include <string>
#include <utility>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::parameters {
namespace {

constexpr char kOdomDrift[] = "'vehicle: {odom_drift_m_per_sqrt_sec: ..}', at the level of the node names";
// Ends of paths that were named differently in earlier versions.
const std::pair<const char*, const char*> kMoved[] = {
    {"navigator/vehicle", "'vehicle: {..}', at the level of the node names, once for all nodes"},
    {"tracker/fit",
     "'vehicle: {half_width_m: .., half_height_m: .., margin_m: ..}', at the level of the node names"},
    {"approach/margin_m", "'vehicle: {margin_m: ..}', at the level of the node names"},
    {"commit/drift_m_per_sqrt_sec", kOdomDrift},
    {"filter/drift_m_per_sqrt_sec", kOdomDrift},
    {"facade/drift_m_per_sqrt_sec", kOdomDrift},
    {"input/max_future_sec", "'vehicle: {stamps: {max_future_sec: ..}}', at the level of the node names"},
    {"stamps", "'vehicle: {stamps: {..}}', at the level of the node names, once for all nodes"},
    {"image_is_rectified", "'vehicle: {image_is_rectified: ..}', at the level of the node names"},
    {"odom_frame", "'vehicle: {odom_frame: ..}', at the level of the node names"},
    {"base_frame", "'vehicle: {base_frame: ..}', at the level of the node names"},
    {"filter/systematic_sigma_px", "'pose: {systematic_sigma_px: ..}'"},
    {"filter/gate_squares", "'nis_gate'"},
    {"tracker/gravity_sigma_rad", "'filter: {attitude_bias_sigma_rad: ..}'"},
    {"facade/likeness_margin", "'distance_margin'"},
    {"interior/most_px", "'max_side_px'"},
};

std::string groupOf(const std::string& path) {
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string nameOf(const std::string& path) { return path.substr(path.rfind('/') + 1); }

bool startsWith(const std::string& path, const std::string& start) {
  return path.compare(0, start.size(), start) == 0;
}

// Whether the last groups and the name of the path are these.
bool endsWith(const std::string& path, const std::string& end) {
  const std::string whole = "/" + path, tail = "/" + end;
  return whole.size() >= tail.size() && startsWith(whole.substr(whole.size() - tail.size()), tail);
}

// Text after "unknown key" for a key of earlier versions; empty for all others.
std::string whatBecameOf(const std::string& path) {
  for (const auto& [end, now] : kMoved)
    if (endsWith(path, end)) return std::string("; it is now ") + now;
  if (endsWith(path, "camera_pose")) return "; it is an argument of the launch files: camera_pose:=..";
  return "";
}

// Number of letters to insert, remove or replace; swapped neighbours count once (optimal string alignment).
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

// The path in yaml: "a/b/c" is "a: {b: {c: ..}}".
std::string inYaml(const std::string& path) {
  const auto slash = path.find('/');
  if (slash == std::string::npos) return path + ": ..";
  return path.substr(0, slash) + ": {" + inYaml(path.substr(slash + 1)) + "}";
}

// A name without its unit counts like one wrong letter.
std::size_t nameDistance(const std::string& name, const std::string& known) {
  return startsWith(known, name + "_") ? 1 : distance(name, known);
}

// Distance of a known path from the unknown one: first by name, then by group.
std::pair<std::size_t, std::size_t> unlikeness(const std::string& path, const std::string& known) {
  return {nameDistance(nameOf(path), nameOf(known)), distance(groupOf(path), groupOf(known))};
}

// The keys of the same group, if they are few; else nothing.
std::string neighboursOf(const std::string& path, const std::vector<std::string>& known) {
  constexpr std::size_t kFew = 16;
  const std::string group = path.substr(0, path.size() - nameOf(path).size());
  std::vector<std::string> names;
  std::string listed;
  for (const auto& key : known) {
    if (!startsWith(key, group)) continue;
    const std::string name = key.substr(group.size(), key.find('/', group.size()) - group.size());
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    listed += (names.empty() ? "; there is " : ", ") + name;
    names.push_back(name);
  }
  return names.size() > kFew ? "" : listed;
}

// All keys of that name, those of the path's own node if there are any: the intended one is unknown.
std::vector<std::string> namesakesOf(const std::string& nearest, const std::string& path,
                                     const std::vector<std::string>& known) {
  const std::string node = path.substr(0, path.find('/') + 1);
  std::vector<std::string> namesakes;
  for (const auto& key : known)
    if (nameOf(key) == nameOf(nearest) && (!startsWith(nearest, node) || startsWith(key, node)))
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
