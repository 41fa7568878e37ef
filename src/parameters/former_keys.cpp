#include "parameters/former_keys.hpp"

#include <utility>

namespace window_ingress::parameters {
namespace {

// Ends of paths that had another name in earlier versions.
const std::pair<const char*, const char*> kMoved[] = {
    {"navigator/vehicle", "'vehicle: {..}', beside the nodes: said once for all of them"},
    {"tracker/fit", "'vehicle: {half_width_m: .., half_height_m: .., margin_m: ..}', beside the nodes"},
    {"approach/margin_m", "'vehicle: {margin_m: ..}', beside the nodes"},
    {"commit/drift_m_per_sqrt_sec", "'vehicle: {odom_drift_m_per_sqrt_sec: ..}', beside the nodes"},
    {"filter/drift_m_per_sqrt_sec", "'vehicle: {odom_drift_m_per_sqrt_sec: ..}', beside the nodes"},
    {"facade/drift_m_per_sqrt_sec", "'vehicle: {odom_drift_m_per_sqrt_sec: ..}', beside the nodes"},
    {"input/max_future_sec", "'vehicle: {stamps: {max_future_sec: ..}}', beside the nodes"},
    {"stamps", "'vehicle: {stamps: {..}}', beside the nodes: said once for all of them"},
    {"image_is_rectified", "'vehicle: {image_is_rectified: ..}', beside the nodes"},
    {"odom_frame", "'vehicle: {odom_frame: ..}', beside the nodes"},
    {"base_frame", "'vehicle: {base_frame: ..}', beside the nodes"},
    {"filter/systematic_sigma_px", "'pose: {systematic_sigma_px: ..}'"},
    {"filter/gate_squares", "'nis_gate'"},
    {"tracker/gravity_sigma_rad", "'filter: {attitude_bias_sigma_rad: ..}'"},
    {"facade/likeness_margin", "'distance_margin'"},
    {"interior/most_px", "'max_side_px'"},
};

struct Group {
  const char* path;
  const char* names;
};

// What is no parameter any more: groups, and names in them. Those of a node have an empty group.
const Group kConstants[] = {
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

bool endsWith(const std::string& path, const std::string& end) {
  if (path.size() < end.size() || path.compare(path.size() - end.size(), end.size(), end) != 0) return false;
  return path.size() == end.size() || path[path.size() - end.size() - 1] == '/';
}

bool isConstant(const std::string& path, const Group& group) {
  const std::string name = path.substr(path.rfind('/') + 1);
  const std::string end = *group.path == '\0' ? name : std::string(group.path) + "/" + name;
  return std::string(group.names).find(" " + name + " ") != std::string::npos && endsWith(path, end);
}

}  // namespace

std::string whatBecameOf(const std::string& path) {
  for (const auto& [end, now] : kMoved)
    if (endsWith(path, end)) return std::string("; it is now ") + now;
  for (const Group& group : kConstants)
    if (isConstant(path, group)) return "; it is a constant now: leave it out";
  return "";
}

}  // namespace window_ingress::parameters
