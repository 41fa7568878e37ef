#include "evaluation/images/detection_table.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <vector>

#include "evaluation/csv.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

using detection::CandidateTrace;

std::string windowValues(const std::optional<detection::WindowObservation>& window) {
  if (!window) return "0,,,,,,,,,,";
  std::string text = formatted("1,%.4f,", window->score);
  if (window->has_appearance) text += formatted("%.4f", window->bhattacharyya);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d& corner = window->corners[i];
    text += window->corner_visible[i] ? formatted(",%.3f,%.3f", corner.x(), corner.y()) : ",,";
  }
  return text;
}

std::string candidateValues(const CandidateTrace& candidate) {
  std::string text = formatted(",%s,%s,%.4g,%.4g,%.4f,", toString(candidate.source),
                               toString(candidate.reject), candidate.value, candidate.limit, candidate.score);
  if (candidate.has_appearance) text += formatted("%.4f", candidate.bhattacharyya);
  return text + csvCorners(candidate.quad, "%.3f");
}

// Ranks from 1; equal candidates keep their order.
template <typename Key>
std::vector<int> placesBy(const std::vector<CandidateTrace>& all, const Key& key) {
  std::vector<int> order(all.size()), places(all.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key(all[a]) < key(all[b]); });
  for (std::size_t i = 0; i < order.size(); ++i) places[order[i]] = static_cast<int>(i) + 1;
  return places;
}

std::string poseValues(const std::optional<estimation::WindowPoseEstimate>& pose) {
  if (!pose) return ",,,,,,,,";
  const Eigen::Quaterniond q(pose->best.T_camera_window.linear());
  const Eigen::Vector3d t = pose->best.T_camera_window.translation();
  std::string text;
  for (double value : {q.x(), q.y(), q.z(), q.w()}) text += formatted("%.9f", value) + ",";
  for (double value : {t.x(), t.y(), t.z()}) text += formatted("%.6f", value) + ",";
  const double odds = pose->alternative ? std::exp(-pose->log_likelihood_ratio) : 0.0;
  return text + formatted("%.6f,%.4g", pose->yaw_sigma_rad, odds);
}

}  // namespace

std::string detectionColumns() {
  return "detected,score,bhattacharyya,x1,y1,x2,y2,x3,y3,x4,y4,reject_reason,qx,qy,qz,qw,tx,ty,tz,yaw_sigma_"
         "rad,"
         "ambiguity,milliseconds";
}

std::string detectionValues(const DetectionRow& row) {
  return windowValues(row.window) + "," + csvField(row.reject_reason) + "," + poseValues(row.pose) + "," +
         formatted("%.3f", row.milliseconds);
}

std::string candidateColumns() {
  return "rank,proposed,source,reason,value,limit,score,bhattacharyya,x1,y1,x2,y2,x3,y3,x4,y4";
}

std::string candidateRows(const std::string& first, const detection::DetectionTrace& trace) {
  const auto& all = trace.candidates;
  const std::vector<int> proposed =
      placesBy(all, [](const CandidateTrace& c) { return std::make_tuple(-c.proposal, 0.0); });
  const std::vector<int> ranks = placesBy(all, [](const CandidateTrace& c) {
    return std::make_tuple(c.reject == detection::RejectReason::kNone ? 0.0 : 1.0, -c.score);
  });
  std::vector<std::string> lines(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    lines[ranks[i] - 1] = first + "," + std::to_string(ranks[i]) + "," +
                          (all[i].proposal > 0.0 ? std::to_string(proposed[i]) : "") +
                          candidateValues(all[i]) + "\n";
  return std::accumulate(lines.begin(), lines.end(), std::string());
}

}  // namespace window_ingress::evaluation
