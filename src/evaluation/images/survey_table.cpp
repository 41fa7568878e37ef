#include <algorithm>

#include "evaluation/images/detection_survey.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

std::string missesOf(const SurveySummary& summary) {
  std::string text;
  for (const auto& [reason, count] : summary.misses())
    text += (text.empty() ? "" : " ") + reason + ":" + std::to_string(count);
  return text;
}

std::string found(const std::string& name, const SurveySummary& s) {
  std::string text = "| " + name + " | " + std::to_string(s.frames());
  for (int i = 0; i < kSurveyVerdicts; ++i)
    text += " | " + formatted("%.1f", 100.0 * s.part(static_cast<SurveyVerdict>(i)));
  text += " | " + formatted("%.1f", 100.0 * s.innerPart());
  return text + " | " + missesOf(s) + " | " + formatted("%.2f", s.medianMilliseconds()) + " |\n";
}

std::string exactness(const std::string& name, const SurveySummary& s) {
  std::string text = "| " + name;
  for (std::size_t bin = 0; bin < s.bins().size(); ++bin) {
    const CornerStatistics& c = s.corners(bin);
    text += " | " + std::to_string(c.frames());
    if (c.frames() == 0) {
      text += " | | | |";
      continue;
    }
    text += formatted(" | %.3f, %.3f | %+.3f, %+.3f | %+.3f | %.3f", c.rms().x(), c.rms().y(), c.mean().x(),
                      c.mean().y(), c.outward(), c.median());
  }
  return text + " |\n";
}

std::string rule(int columns) {
  std::string text = "|";
  for (int i = 0; i < columns; ++i) text += "---|";
  return text + "\n";
}

}  // namespace

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
    text += name + "," + std::to_string(s.frames());
    for (int i = 0; i < kSurveyVerdicts; ++i)
      text += "," + std::to_string(s.count(static_cast<SurveyVerdict>(i)));
    text += "," + missesOf(s);
    for (std::size_t bin = 0; bin < s.bins().size(); ++bin) {
      const CornerStatistics& c = s.corners(bin);
      text += "," + std::to_string(c.frames());
      for (const double value :
           {c.rms().x(), c.rms().y(), c.mean().x(), c.mean().y(), c.outward(), c.median()})
        text += "," + formatted("%.4f", value);
    }
    text += "," + formatted("%.3f", s.medianMilliseconds()) + "\n";
  }
  return text;
}

std::string SurveyTable::markdown() const {
  std::string text = "| scenario | frames";
  for (int i = 0; i < kSurveyVerdicts; ++i)
    text += std::string(" | ") + toString(static_cast<SurveyVerdict>(i)) + " %";
  text += " | inner border % | missed: the true candidate's end | median ms |\n" + rule(kSurveyVerdicts + 5);
  for (const auto& [name, summary] : scenarios_) text += found(name, summary);
  text += "\n| scenario";
  for (const DistanceBin& bin : bins_)
    text += " | hits at " + bin.name() + " | RMS x, y px | mean x, y px | outward px | median px";
  text += " |\n" + rule(1 + 5 * static_cast<int>(bins_.size()));
  for (const auto& [name, summary] : scenarios_) text += exactness(name, summary);
  return text;
}

}  // namespace window_ingress::evaluation
