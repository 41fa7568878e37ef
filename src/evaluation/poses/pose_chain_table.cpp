#include <algorithm>
#include <cmath>

#include "evaluation/poses/pose_chain.hpp"
#include "evaluation/statistics.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

const char* const kSides[] = {"top", "right", "bottom", "left"};

using Group = std::vector<const PoseChainResult*>;

std::map<int, Group> byDistance(const std::vector<PoseChainResult>& results) {
  std::map<int, Group> groups;
  for (const PoseChainResult& result : results)
    groups[static_cast<int>(std::lround(result.distance_m))].push_back(&result);
  return groups;
}

template <typename Value>
double rms(const std::vector<Value>& values) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / std::max<std::size_t>(1, values.size()));
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / std::max<std::size_t>(1, values.size());
}

double medianMagnitude(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  return quantile(values, 0.5);
}

std::string poseRow(int distance_m, const Group& group) {
  std::vector<double> yaw, lateral, distance, normalised;
  int detected = 0, trusted = 0, wrong = 0, trusted_wrong = 0;
  for (const PoseChainResult* r : group) {
    detected += r->detected;
    if (!r->estimate) continue;
    yaw.push_back(r->yaw_error_rad * geometry::kDegreesPerRad);
    lateral.push_back(100.0 * r->lateral_error_m);
    distance.push_back(100.0 * r->distance_error_m / r->distance_m);
    normalised.push_back(r->yaw_error_rad / r->estimate->yaw_sigma_rad);
    trusted += r->estimate->sign_trusted;
    wrong += r->wrong_sign;
    trusted_wrong += r->wrong_sign && r->estimate->sign_trusted;
  }
  return "| " + std::to_string(distance_m) + " | " + std::to_string(group.size()) + " | " +
         std::to_string(detected) + " | " + std::to_string(yaw.size()) + formatted(" | %.4f", rms(yaw)) +
         formatted(" | %.4f", medianMagnitude(yaw)) + formatted(" | %.3f", rms(lateral)) +
         formatted(" | %.3f", rms(distance)) + formatted(" | %.2f", std::pow(rms(normalised), 2)) + " | " +
         std::to_string(trusted) + " | " + std::to_string(wrong) + " | " + std::to_string(trusted_wrong) +
         " |\n";
}

std::string borderRow(int distance_m, int side, const Group& group) {
  std::vector<double> offset, ends, offset_sigmas, turn_sigmas;
  for (const PoseChainResult* r : group) {
    if (!r->borders[side]) continue;
    offset.push_back(r->borders[side]->offset_px);
    ends.push_back(r->borders[side]->ends_px);
    offset_sigmas.push_back(r->borders[side]->offset_sigmas);
    turn_sigmas.push_back(r->borders[side]->turn_sigmas);
  }
  if (offset.empty()) return "";
  return "| " + std::to_string(distance_m) + " | " + kSides[side] + " | " + std::to_string(offset.size()) +
         formatted(" | %.4f", rms(offset)) + formatted(" | %+.4f", mean(offset)) +
         formatted(" | %.4f", medianMagnitude(offset)) + formatted(" | %.4f", rms(ends)) +
         formatted(" | %.2f", std::pow(rms(offset_sigmas), 2)) +
         formatted(" | %.2f", std::pow(medianMagnitude(offset_sigmas) / 0.6745, 2)) +
         formatted(" | %.2f", std::pow(rms(turn_sigmas), 2)) +
         formatted(" | %.2f |\n", std::pow(medianMagnitude(turn_sigmas) / 0.6745, 2));
}

}  // namespace

std::string poseChainColumns() {
  std::string text =
      "scenario,seed,distance_m,true_yaw_rad,true_yaw_from_sight_rad,detected,reject,yaw_error_rad,lateral_"
      "error_m,distance_error_m,yaw_sigma_rad,sigma_u_rad,log_likelihood_ratio,sign_trusted,wrong_sign,"
      "reprojection_rms_px,cost,aspect,aspect_sigma";
  for (const char* side : kSides)
    for (const char* what : {"_offset_px", "_ends_px", "_offset_sigmas", "_turn_sigmas"})
      text += std::string(",") + side + what;
  return text;
}

std::string poseChainRow(const PoseChainResult& r) {
  std::string reject = r.reject;
  std::replace(reject.begin(), reject.end(), ',', ';');
  std::string text = r.scenario + "," + std::to_string(r.seed) + formatted(",%.4f", r.distance_m) +
                     formatted(",%.6f", r.true_yaw_rad) + formatted(",%.6f", r.true_yaw_from_sight_rad) +
                     (r.detected ? ",1," : ",0,") + reject;
  if (!r.estimate) {
    text += std::string(12, ',');
  } else {
    const auto& e = *r.estimate;
    text += formatted(",%.7f", r.yaw_error_rad) + formatted(",%.6f", r.lateral_error_m) +
            formatted(",%.6f", r.distance_error_m) + formatted(",%.7f", e.yaw_sigma_rad) +
            formatted(",%.7f", e.sigma_u_rad) + formatted(",%.3f", e.log_likelihood_ratio) +
            (e.sign_trusted ? ",1" : ",0") + (r.wrong_sign ? ",1" : ",0") +
            formatted(",%.4f", e.best.reprojection_rms_px) + formatted(",%.3f", e.best.cost);
    text += e.aspect ? formatted(",%.5f", e.aspect->ratio) + formatted(",%.5f", e.aspect->sigma)
                     : std::string(",,");
  }
  for (const auto& border : r.borders)
    text += border ? formatted(",%.4f", border->offset_px) + formatted(",%.4f", border->ends_px) +
                         formatted(",%.3f", border->offset_sigmas) + formatted(",%.3f", border->turn_sigmas)
                   : std::string(",,,,");
  return text;
}

std::string poseChainTable(const std::vector<PoseChainResult>& results) {
  std::string text =
      "| m | images | right border | poses | yaw RMSE deg | median deg | lateral RMSE cm | distance RMSE % "
      "| yaw error^2 / variance | sign trusted | wrong | trusted and wrong |\n|" +
      std::string("---|---|---|---|---|---|---|---|---|---|---|---|\n");
  const auto groups = byDistance(results);
  for (const auto& [distance_m, group] : groups) text += poseRow(distance_m, group);
  text +=
      "\n| m | side | count | offset RMS px | mean outwards px | median px | ends RMS px | offset chi^2 | by "
      "median | direction chi^2 | by median |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& [distance_m, group] : groups)
    for (int side = 0; side < 4; ++side) text += borderRow(distance_m, side, group);
  return text;
}

}  // namespace window_ingress::evaluation
