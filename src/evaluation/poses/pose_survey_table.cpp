#include <algorithm>
#include <cstdio>

#include "evaluation/poses/pose_survey.hpp"
#include "evaluation/statistics.hpp"

namespace window_ingress::evaluation {
namespace {

constexpr double kDegree = 0.017453292519943295;

std::string number(const char* pattern, double value) {
  char text[48];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

double ratio(const PoseCellResult& result, int method) {
  return result.methods[method].yawRms() / result.yaw_bound_rad;
}

// Ours may lie above the best peer's by what chance alone gives two equal methods.
bool isBestOrEqual(const PoseCellResult& result) {
  double best_peer = ratio(result, kFirstPeer);
  for (int method = kFirstPeer; method < kPoseMethods; ++method)
    best_peer = std::min(best_peer, ratio(result, method));
  return ratio(result, kOurs) <= best_peer * 1.005;
}

}  // namespace

std::string poseSurveyColumns() {
  std::string text =
      "distance_m,yaw_deg,sample_sigma_px,draws,yaw_bound_deg,lateral_bound_m,sigma_u_deg,decidable,trusted,"
      "trusted_wrong,trusted_yaw_rmse_deg,yaw_consistency";
  for (int method = 0; method < kPoseMethods; ++method)
    for (const char* what : {"_yaw_rmse_deg", "_lateral_rmse_m", "_wrong_signs", "_failed"})
      text += "," + nameOfMethod(method) + what;
  return text;
}

std::string poseSurveyRow(const PoseCellResult& r) {
  std::string text = number("%g", r.cell.distance_m) + number(",%g", r.cell.yaw_rad / kDegree) +
                     number(",%g", r.cell.sample_sigma_px) + "," + std::to_string(r.draws) +
                     number(",%.6f", r.yaw_bound_rad / kDegree) + number(",%.6f", r.lateral_bound_m) +
                     number(",%.6f", r.sigma_u_rad / kDegree) + (r.signIsDecidable() ? ",1," : ",0,") +
                     std::to_string(r.trusted) + "," + std::to_string(r.trusted_wrong) +
                     number(",%.6f", std::sqrt(r.trusted_yaw_squares / std::max(1, r.trusted)) / kDegree) +
                     number(",%.4f", r.yaw_consistency);
  for (const MethodErrors& errors : r.methods)
    text += number(",%.6f", errors.yawRms() / kDegree) + number(",%.6f", errors.lateralRms()) + "," +
            std::to_string(errors.wrong_signs) + "," + std::to_string(errors.failed);
  return text;
}

std::string poseSurveyTable(const std::vector<PoseCellResult>& results) {
  std::string text = "| distance m | yaw deg | noise px | bound deg | sigma_u deg | trusted % |";
  std::string rule = "|---|---|---|---|---|---|";
  for (int method = 0; method < kPoseMethods; ++method)
    text += " " + nameOfMethod(method) + " |", rule += "---|";
  text += "\n" + rule + "\n";
  for (const PoseCellResult& r : results) {
    text += "| " + number("%g", r.cell.distance_m) + number(" | %g", r.cell.yaw_rad / kDegree) +
            number(" | %g", r.cell.sample_sigma_px) + number(" | %.3f", r.yaw_bound_rad / kDegree) +
            number(" | %.3f", r.sigma_u_rad / kDegree) +
            number(" | %.0f |", 100.0 * r.trusted / std::max(1, r.draws));
    for (int method = 0; method < kPoseMethods; ++method) text += number(" %.2f |", ratio(r, method));
    text += "\n";
  }
  return text;
}

std::string poseSurveySummary(const std::vector<PoseCellResult>& results) {
  int draws = 0, trusted = 0, wrong = 0, decidable = 0, best = 0;
  double worst = 0.0;
  const PoseCellResult* at = nullptr;
  for (const PoseCellResult& r : results) {
    draws += r.draws, trusted += r.trusted, wrong += r.trusted_wrong;
    best += isBestOrEqual(r);
    if (!r.signIsDecidable()) continue;
    ++decidable;
    if (ratio(r, kOurs) > worst) worst = ratio(r, kOurs), at = &r;
  }
  const Interval rate = wilson95(wrong, trusted);
  std::string text =
      number("%.0f draws, sign trusted in ", draws) + number("%.0f, of these wrong ", trusted) +
      number("%.0f", wrong) + number(" (%.4f %%, ", 100.0 * wrong / std::max(1, trusted)) +
      number("95 %% interval %.4f", 100.0 * rate.low) + number(" to %.4f %%)\n", 100.0 * rate.high);
  text += "best or equal (0.5 %) in " + std::to_string(best) + " of " + std::to_string(results.size()) +
          " cells\n";
  if (at != nullptr)
    text += number("largest yaw RMSE / bound %.3f", worst) + " of " + std::to_string(decidable) +
            " cells with sigma_u < yaw / 3, at " + number("%g m, ", at->cell.distance_m) +
            number("%g deg, ", at->cell.yaw_rad / kDegree) + number("%g px\n", at->cell.sample_sigma_px);
  return text;
}

}  // namespace window_ingress::evaluation
