#include "evaluation/images/detection_survey.hpp"

#include <algorithm>

#include "evaluation/csv.hpp"
#include "evaluation/images/truth_comparison.hpp"
#include "evaluation/statistics.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

using geometry::Quadrilateral;

constexpr double kOnBorderIou = 0.8;

// The candidate on the true border that got furthest.
std::string fateOfTrueCandidate(const detection::DetectionTrace& trace, const Quadrilateral& truth) {
  double best = kOnBorderIou;
  const detection::CandidateTrace* found = nullptr;
  for (const auto& candidate : trace.candidates) {
    if (!geometry::isConvex(candidate.quad)) continue;
    const double iou = geometry::intersectionOverUnion(candidate.quad, truth);
    if (iou < best) continue;
    best = iou;
    found = &candidate;
  }
  return found ? detection::toString(found->reject) : "unseen";
}

std::string missesOf(const SurveySummary& summary) {
  std::string text;
  for (const auto& [reason, count] : summary.misses)
    text += (text.empty() ? "" : " ") + reason + ":" + std::to_string(count);
  return text;
}

std::string found(const std::string& name, const SurveySummary& s) {
  std::string text = "| " + name + " | " + std::to_string(s.frames);
  for (int i = 0; i < kSurveyVerdicts; ++i)
    text += formatted(" | %.1f", 100.0 * s.part(static_cast<SurveyVerdict>(i)));
  return text + formatted(" | %.1f | %s | %.2f |\n", 100.0 * s.innerPart(), missesOf(s).c_str(),
                          quantile(s.milliseconds, 0.5));
}

std::string exactness(const std::string& name, const SurveySummary& s) {
  std::string text = "| " + name;
  for (const CornerStatistics& c : s.corners) {
    text += " | " + std::to_string(c.frames());
    text += c.frames() == 0 ? " | | | |"
                            : formatted(" | %.3f, %.3f | %+.3f, %+.3f | %+.3f | %.3f", c.rms().x(),
                                        c.rms().y(), c.mean().x(), c.mean().y(), c.outward(), c.median());
  }
  return text + " |\n";
}

double meanCornerDistance(const Quadrilateral& a, const Quadrilateral& b) {
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) sum += (a[i] - b[i]).norm();
  return 0.25 * sum;
}

}  // namespace

const char* toString(SurveyVerdict verdict) {
  static constexpr std::array<const char*, kSurveyVerdicts> kNames{
      "hit", "inexact", "outer_border", "far_border", "wrong_target", "missed", "nothing", "false_alarm"};
  return kNames[static_cast<int>(verdict)];
}

SurveyVerdict judge(const std::optional<Quadrilateral>& found, const SurveyTruth& truth) {
  if (!truth.present) return found ? SurveyVerdict::kFalseAlarm : SurveyVerdict::kNothing;
  if (!found) return SurveyVerdict::kMissed;
  const Quadrilateral* nearest = &truth.inner;
  SurveyVerdict border = geometry::furthestCorner(*found, truth.inner) <= hitTolerance(truth.inner)
                             ? SurveyVerdict::kHit
                             : SurveyVerdict::kInexact;
  const auto consider = [&](const Quadrilateral& other, SurveyVerdict verdict) {
    if (meanCornerDistance(*found, other) >= meanCornerDistance(*found, *nearest)) return;
    nearest = &other;
    border = verdict;
  };
  if (truth.outer) consider(*truth.outer, SurveyVerdict::kOuterBorder);
  consider(truth.far, SurveyVerdict::kFarBorder);
  return geometry::intersectionOverUnion(*found, *nearest) < kOtherWindowIou ? SurveyVerdict::kWrongTarget
                                                                             : border;
}

SurveyResult resultOf(const SurveyImage& sample, const std::optional<detection::WindowObservation>& window,
                      const detection::DetectionTrace& trace, double milliseconds) {
  SurveyResult result{sample, milliseconds, window};
  const bool whole = window && window->whole();
  result.verdict = judge(whole ? std::make_optional(window->corners) : std::nullopt, sample.truth);
  result.outcome = window ? "found" : std::string(detection::toString(trace.outcome)) + ": " + trace.detail;
  if (sample.truth.present) result.true_candidate = fateOfTrueCandidate(trace, sample.truth.inner);
  return result;
}

std::string surveyColumns() {
  const std::string text =
      "scenario,seed,distance_m,off_axis_deg,verdict,score,bhattacharyya,worst_corner_px";
  return text + csvCornerColumns("found") + csvCornerColumns("true") + ",outcome,true_candidate,milliseconds";
}

std::string surveyRow(const SurveyResult& result) {
  const auto& window = result.window;
  std::string text =
      result.scenario + formatted(",%u,%.3f,%.2f,%s,", result.seed, result.distance_m,
                                  result.off_axis_rad * geometry::kDegreesPerRad, toString(result.verdict));
  if (window) text += formatted("%.4f", window->score);
  text += ",";
  if (window && window->has_appearance) text += formatted("%.4f", window->bhattacharyya);
  text += ",";
  if (window && result.truth.present)
    text += formatted("%.3f", geometry::furthestCorner(window->corners, result.truth.inner));
  text += window ? csvCorners(window->corners, "%.4f") : ",,,,,,,,";
  return text + csvCorners(result.truth.inner, "%.4f") + "," + csvField(result.outcome) + "," +
         result.true_candidate + formatted(",%.3f", result.milliseconds);
}

std::string DistanceBin::name() const {
  const std::string nearest = formatted("%g", nearest_m);
  return (nearest_m == farthest_m ? nearest : nearest + "-" + formatted("%g", farthest_m)) + " m";
}

void SurveySummary::add(const SurveyResult& result) {
  ++frames;
  ++counts[static_cast<int>(result.verdict)];
  milliseconds.push_back(result.milliseconds);
  if (result.verdict == SurveyVerdict::kMissed) ++misses[result.true_candidate];
  if (result.verdict != SurveyVerdict::kHit || bins.empty()) return;
  const auto away = [&](const DistanceBin& bin) {
    return std::max({0.0, bin.nearest_m - result.distance_m, result.distance_m - bin.farthest_m});
  };
  const auto nearer = [&](const DistanceBin& a, const DistanceBin& b) { return away(a) < away(b); };
  const auto bin = std::min_element(bins.begin(), bins.end(), nearer) - bins.begin();
  corners[static_cast<std::size_t>(bin)].add(result.window->corners, result.truth.inner);
}

double SurveySummary::innerPart() const {
  const int inner = count(SurveyVerdict::kHit) + count(SurveyVerdict::kInexact);
  const int borders = inner + count(SurveyVerdict::kOuterBorder) + count(SurveyVerdict::kFarBorder);
  return borders > 0 ? static_cast<double>(inner) / borders : 1.0;
}

void SurveyTable::add(const SurveyResult& result) {
  const auto is_same = [&](const auto& entry) { return entry.first == result.scenario; };
  auto entry = std::find_if(scenarios_.begin(), scenarios_.end(), is_same);
  if (entry == scenarios_.end()) entry = scenarios_.insert(entry, {result.scenario, SurveySummary(bins_)});
  entry->second.add(result);
}

std::string SurveyTable::csv() const {
  std::string text = "scenario,frames";
  for (int i = 0; i < kSurveyVerdicts; ++i)
    text += std::string(",") + toString(static_cast<SurveyVerdict>(i));
  text += ",misses";
  for (const DistanceBin& bin : bins_)
    for (const char* column :
         {"frames", "rms_x_px", "rms_y_px", "mean_x_px", "mean_y_px", "outward_px", "median_px"})
      text += "," + std::string(column) + "_" + bin.name();
  text += ",milliseconds\n";
  for (const auto& [name, s] : scenarios_) {
    text += name + "," + std::to_string(s.frames);
    for (const int count : s.counts) text += "," + std::to_string(count);
    text += "," + missesOf(s);
    for (const CornerStatistics& c : s.corners) {
      text += "," + std::to_string(c.frames());
      for (const double value :
           {c.rms().x(), c.rms().y(), c.mean().x(), c.mean().y(), c.outward(), c.median()})
        text += formatted(",%.4f", value);
    }
    text += formatted(",%.3f\n", quantile(s.milliseconds, 0.5));
  }
  return text;
}

std::string SurveyTable::markdown() const {
  std::string head = "| scenario | frames";
  for (int i = 0; i < kSurveyVerdicts; ++i)
    head += std::string(" | ") + toString(static_cast<SurveyVerdict>(i)) + " %";
  std::string text =
      markdownHead(head + " | inner border % | missed: the true candidate's end | median ms |");
  for (const auto& [name, summary] : scenarios_) text += found(name, summary);
  head = "| scenario";
  for (const DistanceBin& bin : bins_)
    head += " | hits at " + bin.name() + " | RMS x, y px | mean x, y px | outward px | median px";
  text += "\n" + markdownHead(head + " |");
  for (const auto& [name, summary] : scenarios_) text += exactness(name, summary);
  return text;
}

}  // namespace window_ingress::evaluation
