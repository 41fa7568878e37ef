#include "evaluation/flights/flight_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "evaluation/csv.hpp"
#include "evaluation/statistics.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

using simulation::Outcome;

std::string number(const std::optional<double>& value) { return value ? formatted("%.4f", *value) : ""; }

std::optional<double> numberIfAny(const CsvReader& row, std::size_t column) {
  return row.text(column).empty() ? std::nullopt : std::optional(row.number(column));
}

std::uint32_t seedOf(const CsvReader& row) {
  constexpr double kMax = std::numeric_limits<std::uint32_t>::max();
  const double seed = row.number(0);
  if (!(seed >= 0.0 && seed <= kMax && seed == std::floor(seed)))
    row.fail("seed '" + row.text(0) + "' is not a whole number from 0 to 4294967295");
  return static_cast<std::uint32_t>(seed);
}

double quantileOf(const CsvReader& row, std::size_t column) {
  const double quantile = row.number(column);
  if (!(quantile >= 0.0 && quantile <= 1.0))
    row.fail(row.columns()[column] + " '" + row.text(column) + "' is not from 0 to 1");
  return quantile;
}

Outcome outcomeOf(const CsvReader& row) {
  const std::string name = row.text(1);
  for (const Outcome outcome : {Outcome::kRunning, Outcome::kPassed, Outcome::kCollision,
                                Outcome::kFalseIngress, Outcome::kAborted, Outcome::kTimeout})
    if (name == toString(outcome)) return outcome;
  row.fail("'" + name + "' is not an outcome");
}

FlightResult flightOf(const CsvReader& row) {
  FlightResult flight;
  flight.seed = seedOf(row);
  flight.outcome = outcomeOf(row);
  flight.time_sec = row.number(2);
  flight.offset_y_m = numberIfAny(row, 3);
  flight.offset_z_m = numberIfAny(row, 4);
  flight.min_clearance_m = numberIfAny(row, 5);
  flight.wrong_side_m = row.number(6);
  flight.max_speed_mps = row.number(7);
  flight.blind_sec = row.number(8);
  flight.predicted_miss_m = numberIfAny(row, 9);
  flight.reason = row.text(10);
  flight.nearest_m = row.number(11);
  flight.forbidden = row.text(12);
  return flight;
}

std::string targetOf(const FlightRecord& record) {
  if (!record.has_target) return std::string(8, ',');
  return formatted(",%d,%.3f,%.4f,%.4f,%.4f,%.5f,%.4f,%.5f", record.sign_trusted ? 1 : 0,
                   record.target_age_sec, record.target_error_m.x(), record.target_error_m.y(),
                   record.target_error_m.z(), record.target_yaw_error_rad, record.target_sigma_m,
                   record.target_yaw_sigma_rad);
}

std::string imageOf(const FlightRecord& record) {
  if (!record.image) return std::string(7, ',');
  const ImageRecord& image = *record.image;
  return formatted(",%.4f,%.5f,%d,%.4f,%.4f,%.2f,%.2f", image.time_sec, image.yaw_rad,
                   image.sign_trusted ? 1 : 0, image.opening_width_m, image.opening_height_m,
                   image.left_side_px, image.right_side_px);
}

std::string replaced(std::string text, char old, char by) {
  std::replace(text.begin(), text.end(), old, by);
  return text;
}

nlohmann::json quantileOrNull(const std::vector<double>& values, double fraction) {
  return values.empty() ? nlohmann::json() : nlohmann::json(quantile(values, fraction));
}

}  // namespace

std::map<std::string, int> causesOf(const std::vector<FlightResult>& flights) {
  std::map<std::string, int> causes;
  for (const auto& flight : flights)
    if (flight.outcome != Outcome::kPassed)
      ++causes[std::string(toString(flight.outcome)) + ": " + withoutNumbers(flight.reason)];
  return causes;
}

std::string toJson(const std::vector<FlightResult>& flights, const CampaignFacts& facts) {
  std::map<std::string, int> outcomes;
  std::vector<double> times, offsets, wrong_sides;
  for (const auto& flight : flights) {
    ++outcomes[toString(flight.outcome)];
    wrong_sides.push_back(flight.wrong_side_m);
    if (flight.outcome == Outcome::kPassed) times.push_back(flight.time_sec);
    if (flight.offset_y_m && flight.offset_z_m)
      offsets.push_back(std::max(std::abs(*flight.offset_y_m), std::abs(*flight.offset_z_m)));
  }
  const int all = static_cast<int>(flights.size()), passed = static_cast<int>(times.size());
  const Interval rate = wilson95(passed, all);
  const nlohmann::json json{{"scenario", facts.scenario},
                            {"seeds", facts.seeds},
                            {"draws", facts.draws},
                            {"params", facts.params},
                            {"warnings", facts.warnings},
                            {"pictures", facts.with_images},
                            {"version", facts.version},
                            {"flights", all},
                            {"passed", passed},
                            {"pass_rate", static_cast<double>(passed) / std::max(1, all)},
                            {"pass_rate_low_95", rate.low},
                            {"pass_rate_high_95", rate.high},
                            {"outcomes", outcomes},
                            {"causes", causesOf(flights)},
                            {"median_time_s", quantileOrNull(times, 0.5)},
                            {"p95_time_s", quantileOrNull(times, 0.95)},
                            {"p95_offset_m", quantileOrNull(offsets, 0.95)},
                            {"p95_wrong_side_m", quantileOrNull(wrong_sides, 0.95)}};
  return json.dump(2) + "\n";
}

std::string csvHeader() {
  return "seed,outcome,time_s,offset_y_m,offset_z_m,min_clearance_m,wrong_side_m,max_speed_mps,blind_s,"
         "predicted_miss_m,reason,nearest_m,forbidden";
}

std::string csvRow(const FlightResult& flight) {
  return formatted("%u,%s,%.3f,", flight.seed, toString(flight.outcome), flight.time_sec) +
         number(flight.offset_y_m) + "," + number(flight.offset_z_m) + "," + number(flight.min_clearance_m) +
         formatted(",%.4f,%.4f,%.3f,", flight.wrong_side_m, flight.max_speed_mps, flight.blind_sec) +
         number(flight.predicted_miss_m) + "," + csvField(replaced(flight.reason, '\n', ' ')) +
         formatted(",%.4f,", flight.nearest_m) + csvField(replaced(flight.forbidden, '\n', ' '));
}

std::string trackHeader() { return "seed,time_s,x_m,y_m,z_m"; }

std::string trackRows(const FlightResult& flight) {
  std::string rows;
  for (const TrackPoint& point : flight.track)
    rows += formatted("%u,%.3f,%.4f,%.4f,%.4f\n", flight.seed, point.time_sec, point.position_m.x(),
                      point.position_m.y(), point.position_m.z());
  return rows;
}

std::vector<FlightResult> readFlights(const std::string& folder) {
  std::vector<FlightResult> flights;
  std::map<std::uint32_t, std::vector<TrackPoint>> tracks;
  CsvReader points(folder + "/tracks.csv", trackHeader());
  while (points.nextFinished())
    tracks[seedOf(points)].push_back(
        {points.number(1), {points.number(2), points.number(3), points.number(4)}});
  CsvReader rows(folder + "/flights.csv", csvHeader());
  while (rows.nextFinished()) {
    flights.push_back(flightOf(rows));
    flights.back().track = tracks[flights.back().seed];
  }
  return flights;
}

FlightDraws readDraws(const std::string& file) {
  CsvReader rows(file);
  const auto& keys = rows.columns();
  if (keys.front() != "seed") rows.fail("must begin with 'seed'");
  FlightDraws draws;
  while (rows.nextWhole()) {
    const auto [draw, is_new] = draws.try_emplace(seedOf(rows));
    if (!is_new) rows.fail("seed " + rows.text(0) + " is listed twice");
    for (std::size_t i = 1; i < keys.size(); ++i) draw->second[keys[i]] = quantileOf(rows, i);
  }
  return draws;
}

std::vector<FlightResult> joinFlights(const std::vector<std::string>& folders) {
  std::map<std::uint32_t, FlightResult> by_seed;
  for (const auto& folder : folders)
    for (auto& flight : readFlights(folder)) {
      const std::uint32_t seed = flight.seed;
      if (!by_seed.emplace(seed, std::move(flight)).second)
        throw InputError(folder + "/flights.csv: seed " + std::to_string(seed) + " was flown twice");
    }
  std::vector<FlightResult> flights;
  for (auto& entry : by_seed) flights.push_back(std::move(entry.second));
  return flights;
}

void writeCsv(const FlightLog& log, std::ostream& out) {
  out << "time_s,state,x_m,y_m,z_m,heading_rad,vx_mps,vy_mps,vz_mps,set_x_mps,set_y_mps,set_z_mps,set_yaw_"
         "radps,detected,trusted,age_s,error_x_m,error_y_m,error_z_m,error_yaw_rad,sigma_m,sigma_yaw_rad,"
         "image_s,image_yaw_rad,image_trusted,image_width_m,image_height_m,image_left_px,image_right_px,"
         "predicted_miss_m,sighting,reason\n";
  for (const auto& r : log.records)
    out << formatted("%.4f,%s,%.4f,%.4f,%.4f,%.4f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%d", r.time_sec,
                     toString(r.state), r.position_m.x(), r.position_m.y(), r.position_m.z(), r.heading_rad,
                     r.velocity_mps.x(), r.velocity_mps.y(), r.velocity_mps.z(), r.setpoint_mps.x(),
                     r.setpoint_mps.y(), r.setpoint_mps.z(), r.setpoint_yaw_rate_radps, r.detected ? 1 : 0)
        << targetOf(r) << imageOf(r) << ","
        << (r.predicted_miss_m > 0.0 ? formatted("%.4f", r.predicted_miss_m) : "") << ","
        << replaced(r.sighting, ',', ';') << "," << replaced(r.reason, ',', ';') << "\n";
}

}  // namespace window_ingress::evaluation
