#include "evaluation/openness/openness_survey.hpp"

#include <algorithm>
#include <chrono>

#include "evaluation/csv.hpp"
#include "evaluation/openness/openness_approach.hpp"
#include "evaluation/statistics.hpp"
#include "simulation/camera/camera_sensor.hpp"
#include "window_ingress/openness/interior_klt_tracker.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

std::string rate(int count, int trials) {
  const auto [low, high] = wilson95(count, trials);
  return formatted("%d (%.2f .. %.2f %%)", count, 100.0 * low, 100.0 * high);
}

}  // namespace

OpennessResult flyDrawn(const simulation::Scenario& scenario, std::uint32_t seed, const OpennessRange& range,
                        const openness::InteriorKltParams& follower, const openness::OpennessParams& params,
                        const OpennessStep& each) {
  using Clock = std::chrono::steady_clock;
  const simulation::Scene scene = simulation::buildScene(scenario);
  const geometry::PinholeCamera camera = scenario.camera.model();
  simulation::CameraSensor sensor(scene, scenario.camera, seed);
  OpennessApproach approach(range, scenario.opening(), params, seed);
  openness::InteriorKltTracker interior(follower);
  OpennessResult result;
  result.seed = seed;
  result.is_open = scenario.window.isOpen();
  result.kind = !scenario.window.present ? "poster" : result.is_open ? "room" : scenario.window.closed_by;
  result.room_m = result.is_open ? scenario.house.room_depth_m : 0.0;
  int images = 0;
  for (int i = 0; i < approach.steps(); ++i) {
    const cv::Mat image =
        sensor.expose(approach.motion(i), static_cast<std::uint64_t>(i), approach.timeSec(i));
    auto window = approach.look(camera, i);
    if (!window) continue;
    const auto begun = Clock::now();
    interior.follow(image, *window);
    approach.judge(*window, camera, i);
    result.milliseconds += std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
    ++images;
    approach.note(i, result, each);
  }
  result.milliseconds /= std::max(1, images);
  return result;
}

void OpennessTable::add(const OpennessResult& result) {
  auto found =
      std::find_if(rows_.begin(), rows_.end(), [&](const auto& row) { return row.first == result.kind; });
  if (found == rows_.end()) found = rows_.insert(rows_.end(), {result.kind, {}});
  Row& row = found->second;
  row.is_open = result.is_open;
  ++row.flights;
  row.open += result.at_decision.openness == openness::Openness::kOpen;
  row.closed += result.at_decision.openness == openness::Openness::kClosed;
  row.ever_open += result.ever_open;
  row.ever_closed += result.ever_closed;
  false_open_ += result.ever_open && !result.is_open;
  if (result.ever_open) row.open_from_m.push_back(result.open_from_m);
  row.milliseconds.push_back(result.milliseconds);
}

std::string OpennessTable::markdown() const {
  std::string out = markdownHead(
      "| within the border | is | approaches | OPEN at the decision | CLOSED | UNKNOWN | ever OPEN | ever "
      "CLOSED | OPEN from, median m | ms an image |");
  for (const auto& [kind, row] : rows_)
    out += formatted("| %s | %s | %d | %s | %s | %d | %d | %d | %s | %.3f |\n", kind.c_str(),
                     row.is_open ? "open" : "not open", row.flights, rate(row.open, row.flights).c_str(),
                     rate(row.closed, row.flights).c_str(), row.flights - row.open - row.closed,
                     row.ever_open, row.ever_closed,
                     row.open_from_m.empty() ? "" : formatted("%.2f", quantile(row.open_from_m, 0.5)).c_str(),
                     quantile(row.milliseconds, 0.5));
  return out;
}

std::string opennessColumns() {
  return "kind,is_open,room_m,seed,verdict,log_odds,depth_behind_m,depth_sigma_m,open_share,stretches,points,"
         "ever_open,ever_closed,open_from_m,reason";
}

std::string opennessRow(const OpennessResult& result) {
  const auto& v = result.at_decision;
  return formatted("%s,%d,%.3f,%u,%s,%.3f,%.3f,%.3f,%.3f,%d,%d,%d,%d,%.3f,\"%s\"", result.kind.c_str(),
                   result.is_open, result.room_m, result.seed, openness::toString(v.openness), v.log_odds,
                   v.depth_behind_m, v.depth_sigma_m, v.open_share, v.stretches, v.points, result.ever_open,
                   result.ever_closed, result.open_from_m, v.reason.c_str());
}

}  // namespace window_ingress::evaluation
