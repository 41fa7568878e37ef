#include <algorithm>

#include "evaluation/poses/pose_survey.hpp"
#include "evaluation/statistics.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

double ratio(const PoseCellResult& result, int method) {
  return result.methods[method].yawRms() / result.yaw_bound_rad;
}

// Ours may exceed the best peer by the random difference of two equal methods.
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
      text += std::string(",") + nameOfMethod(method) + what;
  return text;
}

std::string poseSurveyRow(const PoseCellResult& r) {
  std::string text =
      formatted("%g,%g,%g,%d,%.6f,%.6f,%.6f,%d,%d,%d,%.6f,%.4f", r.cell.distance_m,
                r.cell.yaw_rad * geometry::kDegreesPerRad, r.cell.sample_sigma_px, r.draws,
                r.yaw_bound_rad * geometry::kDegreesPerRad, r.lateral_bound_m,
                r.sigma_u_rad * geometry::kDegreesPerRad, r.signIsDecidable(), r.trusted, r.trusted_wrong,
                std::sqrt(r.trusted_yaw_squares / std::max(1, r.trusted)) * geometry::kDegreesPerRad,
                r.yaw_consistency);
  for (const MethodErrors& errors : r.methods)
    text += formatted(",%.6f,%.6f,%d,%d", errors.yawRms() * geometry::kDegreesPerRad, errors.lateralRms(),
                      errors.wrong_signs, errors.failed);
  return text;
}

std::string poseSurveyTable(const std::vector<PoseCellResult>& results) {
  std::string text = "| distance m | yaw deg | noise px | bound deg | sigma_u deg | trusted % |";
  std::string rule = "|---|---|---|---|---|---|";
  for (int method = 0; method < kPoseMethods; ++method)
    text += std::string(" ") + nameOfMethod(method) + " |", rule += "---|";
  text += "\n" + rule + "\n";
  for (const PoseCellResult& r : results) {
    text += formatted("| %g | %g | %g | %.3f | %.3f | %.0f |", r.cell.distance_m,
                      r.cell.yaw_rad * geometry::kDegreesPerRad, r.cell.sample_sigma_px,
                      r.yaw_bound_rad * geometry::kDegreesPerRad, r.sigma_u_rad * geometry::kDegreesPerRad,
                      100.0 * r.trusted / std::max(1, r.draws));
    for (int method = 0; method < kPoseMethods; ++method) text += formatted(" %.2f |", ratio(r, method));
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
  std::string text = formatted(
      "%d draws, sign trusted in %d, of these wrong %d (%.4f %%, 95 %% interval %.4f to %.4f %%)\n", draws,
      trusted, wrong, 100.0 * wrong / std::max(1, trusted), 100.0 * rate.low, 100.0 * rate.high);
  text += formatted("best or equal (0.5 %%) in %d of %zu cells\n", best, results.size());
  if (at != nullptr)
    text += formatted(
        "largest yaw RMSE / bound %.3f of %d cells with sigma_u < yaw / 3, at %g m, %g deg, %g px\n", worst,
        decidable, at->cell.distance_m, at->cell.yaw_rad * geometry::kDegreesPerRad,
        at->cell.sample_sigma_px);
  return text;
}

}  // namespace window_ingress::evaluation
