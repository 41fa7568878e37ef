#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/images/corner_statistics.hpp"
#include "evaluation/images/survey_image.hpp"
#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/window_observation.hpp"

namespace window_ingress::evaluation {

/// Result of the detector for one image.
enum class SurveyVerdict {
  kHit,          ///< the inner border, every corner within `hitTolerance`
  kInexact,      ///< the inner border, but a corner is farther away
  kOuterBorder,  ///< the outer border of the frame instead
  kFarBorder,    ///< the border in the room, at the wall's back, instead
  kWrongTarget,  ///< something else instead
  kMissed,       ///< nothing found
  kNothing,      ///< nothing found, no window present
  kFalseAlarm    ///< something found, no window present
};
constexpr int kSurveyVerdicts = static_cast<int>(SurveyVerdict::kFalseAlarm) + 1;
const char* toString(SurveyVerdict verdict);

/// The window's border that a quadrilateral matches: the one with the nearest corners on average, if their
/// intersection is at least half of their union.
SurveyVerdict judge(const std::optional<geometry::Quadrilateral>& found, const SurveyTruth& truth);

/// One image of the survey.
struct SurveyResult : SurveySubject {
  double milliseconds = 0.0;
  std::optional<detection::WindowObservation> window;
  SurveyVerdict verdict = SurveyVerdict::kMissed;
  std::string outcome = {};  ///< outcome of the whole image, for people
  /// Gate that rejected the best candidate on the inner border; "unseen" if there is none.
  std::string true_candidate = {};
};

SurveyResult resultOf(const SurveyImage& sample, const std::optional<detection::WindowObservation>& window,
                      const detection::DetectionTrace& trace, double milliseconds);

std::string surveyColumns();
std::string surveyRow(const SurveyResult& result);  ///< without line end

/// Range of distances whose corners are evaluated together, in rising order.
struct DistanceBin {
  double nearest_m, farthest_m;
  std::string name() const;  ///< "2-3 m", or "2 m"
};
const std::vector<DistanceBin> kDefaultBins{{2.0, 3.0}, {3.0, 5.0}, {5.0, 8.0}};

/// One scenario, or all of them.
struct SurveySummary {
  explicit SurveySummary(const std::vector<DistanceBin>& in_bins) : bins(in_bins), corners(bins.size()) {}

  void add(const SurveyResult& result);
  int count(SurveyVerdict verdict) const { return counts[static_cast<int>(verdict)]; }
  double part(SurveyVerdict verdict) const { return 1.0 * count(verdict) / std::max(1, frames); }  ///< 0 to 1
  /// Part with the inner border among the frames in which any border of the window was found; 1 if there are
  /// none.
  double innerPart() const;

  int frames = 0;
  std::array<int, kSurveyVerdicts> counts{};
  std::vector<DistanceBin> bins;
  std::vector<CornerStatistics> corners;  ///< of the hits whose distance is nearest to the i-th bin
  std::map<std::string, int> misses;      ///< by the gate that rejected the true candidate
  std::vector<double> milliseconds;
};

/// Scenarios in the order of arrival.
class SurveyTable {
 public:
  explicit SurveyTable(const std::vector<DistanceBin>& bins = kDefaultBins) : bins_(bins) {}
  void add(const SurveyResult& result);
  std::string csv() const;       ///< one row per scenario
  std::string markdown() const;  ///< the same in two tables: detections, and accuracy

 private:
  std::vector<DistanceBin> bins_;
  std::vector<std::pair<std::string, SurveySummary>> scenarios_;
};

}  // namespace window_ingress::evaluation
