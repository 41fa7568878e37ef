#include "evaluation/images/track_survey.hpp"

#include <algorithm>
#include <cmath>

#include "evaluation/csv.hpp"
#include "evaluation/images/detection_survey.hpp"
#include "evaluation/images/truth_comparison.hpp"
#include "evaluation/statistics.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

using Eigen::Vector2d;

constexpr double kMinStretch = 1.0 / 12.0;  // of the image's longer side
constexpr int kMinSides = 2;

// Length of a segment's part within the image, by clipping along both axes (Liang and Barsky).
double lengthWithin(const Vector2d& from, const Vector2d& to, const geometry::PinholeCamera& camera) {
  const Vector2d way = to - from, end(camera.width - 1.0, camera.height - 1.0);
  double first = 0.0, last = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(way[axis]) < 1e-12) {
      if (from[axis] < 0.0 || from[axis] > end[axis]) return 0.0;
      continue;
    }
    const double a = -from[axis] / way[axis], b = (end[axis] - from[axis]) / way[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return std::max(0.0, last - first) * way.norm();
}

TrackVerdict verdictOfWhole(const geometry::Quadrilateral& corners, const SurveyTruth& truth) {
  const SurveyVerdict verdict = judge(corners, truth);
  if (verdict == SurveyVerdict::kHit) return TrackVerdict::kWhole;
  if (verdict == SurveyVerdict::kOuterBorder) return TrackVerdict::kOuter;
  return verdict == SurveyVerdict::kFarBorder ? TrackVerdict::kFar : TrackVerdict::kWrong;
}

}  // namespace

const char* toString(TrackVerdict verdict) {
  static constexpr std::array<const char*, kTrackVerdicts> kNames{"whole",        "partial",    "nothing",
                                                                  "outer_border", "far_border", "wrong"};
  return kNames[static_cast<int>(verdict)];
}

double worstSideDistance(const detection::WindowObservation& window, const geometry::Quadrilateral& truth,
                         const geometry::PinholeCamera& camera) {
  double worst = 0.0;
  for (int side = 0; side < 4; ++side) {
    if (!window.edges[side].visible) continue;
    const Vector2d from = camera.undistort(truth[side]), to = camera.undistort(truth[(side + 1) % 4]);
    const Vector2d along = (to - from).normalized(), across(-along.y(), along.x());
    for (const Vector2d& end : {window.edges[side].a, window.edges[side].b})
      worst = std::max(worst, std::abs(across.dot(camera.undistort(end) - from)));
  }
  return worst;
}

int sidesInView(const geometry::Quadrilateral& truth, const geometry::PinholeCamera& camera) {
  const double least_px = kMinStretch * std::max(camera.width, camera.height);
  int sides = 0;
  for (int side = 0; side < 4; ++side)
    sides += lengthWithin(truth[side], truth[(side + 1) % 4], camera) >= least_px;
  return sides;
}

void judge(TrackResult& result, const geometry::PinholeCamera& camera) {
  result.sides_in_view = sidesInView(result.truth.inner, camera);
  result.verdict = TrackVerdict::kNothing;
  result.error_px = 0.0;
  if (!result.window) return;
  const auto& truth = result.truth.inner;
  if (result.window->whole()) {
    result.error_px = geometry::furthestCorner(result.window->corners, truth);
    result.verdict = verdictOfWhole(result.window->corners, result.truth);
  } else {
    result.error_px = worstSideDistance(*result.window, truth, camera);
    result.verdict = result.error_px <= hitTolerance(truth) ? TrackVerdict::kPartial : TrackVerdict::kWrong;
  }
}

std::string trackColumns() {
  return "seed,frame,plane_m,sides_in_view,verdict,searched,target_id,visible_sides,score,error_px,"
         "milliseconds";
}

std::string trackRow(const TrackResult& result) {
  std::string text = formatted("%u,%d,%.3f,%d,%s,%d,", result.seed, result.frame, result.plane_m,
                               result.sides_in_view, toString(result.verdict), result.searched);
  if (const auto& window = result.window)
    text += formatted("%u,%d,%.4f,%.4f", window->target_id, window->visibleSides(), window->score,
                      result.error_px);
  else
    text += ",,,";
  return text + formatted(",%.3f", result.milliseconds);
}

void TrackSummary::add(const TrackResult& result) {
  if (result.seed != seed_) target_id_ = 0;
  seed_ = result.seed;
  if (result.window) {
    swaps_ += target_id_ != 0 && result.window->target_id != target_id_;
    target_id_ = result.window->target_id;
  }
  if (result.sides_in_view < kMinSides && result.verdict <= TrackVerdict::kNothing) return;
  std::size_t i = 0;
  while (i + 1 < kFrom_m.size() && result.plane_m < kFrom_m[i]) ++i;
  Range& range = ranges_[i];
  ++range.frames;
  ++range.counts[static_cast<int>(result.verdict)];
  if (!result.searched) range.following_ms.push_back(result.milliseconds);
  if (result.verdict == TrackVerdict::kWhole) range.corners.add(result.window->corners, result.truth.inner);
  if (result.verdict == TrackVerdict::kPartial) range.side_errors_px.push_back(result.error_px);
}

std::string TrackSummary::markdownHeader() {
  std::string head = "| scenario | to the plane | frames";
  for (int i = 0; i < kTrackVerdicts; ++i)
    head += std::string(" | ") + toString(static_cast<TrackVerdict>(i)) + " %";
  return markdownHead(
      head +
      " | corner RMS x, y px | outward px | worst side, median px | following, median ms | number swaps |");
}

std::string TrackSummary::markdown(const std::string& name) const {
  const auto median = [](const std::vector<double>& values) {
    return " | " + (values.empty() ? "" : formatted("%.3f", quantile(values, 0.5)));
  };
  std::string text;
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    const auto& [frames, counts, corners, side_errors_px, following_ms] = ranges_[i];
    text +=
        "| " + name + " | " +
        (i == 0 ? formatted("over %g m", kFrom_m[0]) : formatted("%g to %g m", kFrom_m[i - 1], kFrom_m[i])) +
        " | " + std::to_string(frames);
    for (const int count : counts) text += frames > 0 ? formatted(" | %.1f", 100.0 * count / frames) : " | ";
    text += corners.frames() > 0
                ? formatted(" | %.3f, %.3f | %+.3f", corners.rms().x(), corners.rms().y(), corners.outward())
                : " | | ";
    text += median(side_errors_px) + median(following_ms);
    text += " | " + (i == 0 ? std::to_string(swaps_) : "") + " |\n";
  }
  return text;
}

}  // namespace window_ingress::evaluation
