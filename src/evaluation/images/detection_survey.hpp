#pragma once

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
struct SurveyResult {
  std::string scenario;
  std::uint32_t seed = 0;
  double distance_m = 0.0, off_axis_rad = 0.0, milliseconds = 0.0;
  SurveyTruth truth;
  std::optional<detection::WindowObservation> window;
  SurveyVerdict verdict = SurveyVerdict::kMissed;
  std::string outcome;  ///< outcome of the whole image, for people
  /// Gate that rejected the best candidate on the inner border; "unseen" if there is none.
  std::string true_candidate;
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
std::vector<DistanceBin> defaultBins();                                   ///< 2 to 3, 3 to 5 and 5 to 8 m
std::vector<DistanceBin> binsAt(const std::vector<double>& distances_m);  ///< one bin each

/// One scenario, or all of them.
class SurveySummary {
 public:
  explicit SurveySummary(const std::vector<DistanceBin>& bins) : bins_(bins), corners_(bins.size()) {}

  void add(const SurveyResult& result);
  int frames() const { return frames_; }
  int count(SurveyVerdict verdict) const { return counts_[static_cast<int>(verdict)]; }
  double part(SurveyVerdict verdict) const;  ///< 0 to 1
  /// Part with the inner border among the frames in which any border of the window was found; 1 if there are
  /// none.
  double innerPart() const;
  /// Corners of the hits whose distance is nearest to the i-th bin.
  const CornerStatistics& corners(std::size_t bin) const { return corners_.at(bin); }
  const std::vector<DistanceBin>& bins() const { return bins_; }
  const std::map<std::string, int>& misses() const {
    return misses_;
  }  ///< by the gate that rejected the true candidate
  double medianMilliseconds() const;

 private:
  std::size_t binOf(double distance_m) const;

  int frames_ = 0;
  std::array<int, kSurveyVerdicts> counts_{};
  std::vector<DistanceBin> bins_;
  std::vector<CornerStatistics> corners_;
  std::map<std::string, int> misses_;
  std::vector<double> milliseconds_;
};

/// Scenarios in the order of arrival.
class SurveyTable {
 public:
  explicit SurveyTable(const std::vector<DistanceBin>& bins = defaultBins()) : bins_(bins) {}
  void add(const SurveyResult& result);
  std::string csv() const;       ///< one row per scenario
  std::string markdown() const;  ///< the same in two tables: detections, and accuracy

 private:
  std::vector<DistanceBin> bins_;
  std::vector<std::pair<std::string, SurveySummary>> scenarios_;
};

}  // namespace window_ingress::evaluation
