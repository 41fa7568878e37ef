#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/images/corner_statistics.hpp"
#include "evaluation/images/survey_image.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::evaluation {

/// Result for one frame of a flight towards the window.
enum class TrackVerdict {
  kWhole,    ///< all four corners, on the inner border within `hitTolerance`
  kPartial,  ///< not all corners, but every side seen lies on its true one within `hitTolerance`
  kNothing,  ///< nothing found
  kOuter,    ///< all four corners, but on the frame's outer border
  kFar,      ///< all four corners, but on the border in the room, at the wall's back
  kWrong     ///< found, but on none of these borders
};
constexpr int kTrackVerdicts = static_cast<int>(TrackVerdict::kWrong) + 1;
const char* toString(TrackVerdict verdict);

/// Largest distance of the ends of the sides seen from the true sides, in the undistorted image [px].
double worstSideDistance(const detection::WindowObservation& window, const geometry::Quadrilateral& truth,
                         const geometry::PinholeCamera& camera);

/// Number of sides of the true border that show at least a twelfth of the image's longer side in the image.
int sidesInView(const geometry::Quadrilateral& truth, const geometry::PinholeCamera& camera);

struct TrackResult {
  std::uint32_t seed = 0;
  int frame = 0;
  double plane_m = 0.0;  ///< distance of the camera from the plane of the opening
  double milliseconds = 0.0;
  bool searched = false;  ///< no track before this image
  int sides_in_view = 0;
  SurveyTruth truth;
  std::optional<detection::WindowObservation> window;
  TrackVerdict verdict = TrackVerdict::kNothing;
  double error_px = 0.0;  ///< of the worst corner or, if partial, of the worst side; 0 if nothing was found
};

/// Fills `verdict`, `error_px` and `sides_in_view` from the rest.
void judge(TrackResult& result, const geometry::PinholeCamera& camera);

std::string trackColumns();
std::string trackRow(const TrackResult& result);  ///< no line end

/// One scenario. Frames count if at least two sides show, or if something wrong was found.
class TrackSummary {
 public:
  /// Lower bounds of the ranges of the plane's distance.
  static constexpr std::array<double, 4> kFrom_m{3.0, 1.5, 0.8, 0.0};

  void add(const TrackResult& result);  ///< flight by flight, frame by frame
  int frames(std::size_t range) const { return ranges_.at(range).frames; }
  int count(std::size_t range, TrackVerdict verdict) const {
    return ranges_.at(range).counts[static_cast<int>(verdict)];
  }
  std::string markdown(const std::string& name) const;
  static std::string markdownHeader();

 private:
  struct Range {
    int frames = 0;
    std::array<int, kTrackVerdicts> counts{};
    CornerStatistics corners;
    std::vector<double> side_errors_px, following_ms;
  };

  std::array<Range, kFrom_m.size()> ranges_;
  int swaps_ = 0;  // frames in which the target's number changed
  std::uint32_t seed_ = 0, target_id_ = 0;
};

}  // namespace window_ingress::evaluation
