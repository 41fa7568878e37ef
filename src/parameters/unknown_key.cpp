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

// Former parameters, now constants: groups and the names in them. Those of a node have an empty group.
const std::pair<const char*, const char*> kConstants[] = {
    {"lines", " max_gap vote_fraction "},
    {"contours", " min_perimeter "},
    {"gates", " min_solidity "},
    {"shape", " sigmas frame_slack "},
    {"appearance", " near_width far_width max_drift "},
    {"track", " reach turn "},
    {"interior",
     " min_points least_slope margin min_contrast max_return_px most_slope flow_sigma_px max_growth "
     "max_key_age_sec min_shared "},
    {"pose",
     " systematic_turn unknown_corner_sigma_px max_reprojection_rms_px min_side_px min_corner_angle_rad "
     "min_range_m max_tilt_rad max_yaw_rad trusted_yaw_sigmas trusted_log_likelihood_ratio "},
    {"filter",
     " known_size_sigma scale_speed_mps unknown_corner_sigma_px systematic_renewal_m systematic_renewal_sec "
     "attitude_bias_time_sec max_mean_squares outliers_until_restart max_evidence dead_weight "
     "harmless_yaw_rad trusted_yaw_sigma_rad consistency_images max_consistency time_jump_sec "},
    {"tracker", " frames max_pose_gap_sec max_jump_m max_turn_jump_rad "},
    {"openness",
     " border_sigma_px position_sigma_m min_baseline_m max_border_misfit max_sigmas max_unsteady min_points "
     "max_log_odds min_open_share "},
    {"facade",
     " corner_sigma_px range_sigma wall_sigma_m max_deviation confirmations forget_sec settled_updates "
     "next_release_sec click_m "},
    {"input", " max_window_shift_m target_jump_persist_sec max_target_tilt_rad "},
    {"search", " max_turn_per_image found_frames "},
    {"align", " dwell_sec settle_sec probe_speed_mps "},
    {"approach", " wind_sec gust_memory_sec gust_carry_sec leave_factor leave_sec "},
    {"commit", " standing_mps max_heading_error_rad max_lateral_speed_mps max_update_jump_m "},
    {"hold", " standing_mps settle_sec dwell_sec "},
    {"", " start_time_sec clock_rate_hz "},
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
  for (const auto& [group, names] : kConstants)
    if (std::string(names).find(" " + nameOf(path) + " ") != std::string::npos &&
        (*group == '\0' || endsWith(groupOf(path), group)))
      return "; it is now a constant: remove it";
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
