#include "window_ingress/openness/openness_judge.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::openness {
namespace {

using geometry::Quadrilateral;

constexpr double kSameStamp_sec = 1e-6, kLongest_sec = 10.0;
constexpr std::size_t kMaxViews = 600;
constexpr double kMinLogOdds = 1.0;  // log odds below which a stretch decides nothing
constexpr double kMisfit_px = 1.5;   // of corners against the filtered window, in addition to kMaxMisfit
constexpr double kMaxClosed = 0.15;  // of the middle that is needed
constexpr double kMinQuarter = 0.5, kMinSide = 0.3;  // open part of each quarter and each side
constexpr double kMaxMisfit = 0.05;                  // of corners against the filtered window [its sizes]
constexpr double kBorderSigma_px = 0.4;              // of a border beyond its own covariance, in each image
constexpr double kPositionSigma_m = 0.02, kMinBaseline_m = 0.12;  // of odometry; between two images compared
constexpr double kMinOpen = 0.5;                                  // of the middle that is needed
constexpr double kMaxTotal = 12.0;
constexpr int kOutvoted = 3;  // stretches that outweigh one that says the opposite

// True if the corners match the filtered window, apart from a shift by a turn of the camera.
bool agrees(const Quadrilateral& seen, const OpennessView& view) {
  const auto expected = geometry::projectOpening(
      view.camera.withoutDistortion(), view.T_odom_camera.inverse() * view.T_odom_window, view.opening);
  if (!expected || !geometry::isFinite(seen)) return false;
  const Eigen::Vector2d shift = geometry::centroid(seen) - geometry::centroid(*expected);
  double worst_px = 0.0;
  for (int i = 0; i < 4; ++i) worst_px = std::max(worst_px, (seen[i] - (*expected)[i] - shift).norm());
  const double size_px = std::sqrt(std::max(0.0, geometry::signedArea(*expected)));
  return worst_px < kMaxMisfit * size_px + kMisfit_px;
}

// True if the line of sight through this place in the border's plane also passes the reveal's rear end.
bool passesReveal(const Eigen::Vector2d& place, const Eigen::Vector3d& eye_window,
                  const geometry::OpeningSize& opening, double reveal_m) {
  const Eigen::Vector3d front(0.0, (0.5 - place.x()) * opening.width_m, (0.5 - place.y()) * opening.height_m);
  const Eigen::Vector3d way = front - eye_window;
  if (!(way.x() > 0.0)) return false;
  const Eigen::Vector3d back = front + reveal_m / way.x() * way;
  return std::abs(back.y()) < 0.5 * opening.width_m && std::abs(back.z()) < 0.5 * opening.height_m;
}

}  // namespace

const char* toString(Openness openness) {
  constexpr const char* kNames[] = {"UNKNOWN", "OPEN", "CLOSED"};
  return kNames[static_cast<std::size_t>(openness)];
}

OpennessJudge::OpennessJudge(const OpennessParams& params, const geometry::OpeningSize& needed)
    : params_(params), needed_(needed) {
  auto faults = parameters::outOfRange(params);
  if (params.max_depth_closed_m >= params.min_depth_behind_m)
    faults.push_back("max_depth_closed_m is not below min_depth_behind_m");
  parameters::throwIfAny(faults, "openness");
}

void OpennessJudge::reset() { *this = OpennessJudge(params_, needed_); }

OpennessJudge::Count OpennessJudge::counted() const {
  Count all = past_;
  all.log_odds = std::clamp(all.log_odds + estimate_.log_odds, -kMaxTotal, kMaxTotal);
  all.open += estimate_.log_odds >= kMinLogOdds;
  all.closed += estimate_.log_odds <= -kMinLogOdds;
  all.moving += estimate_.is_moving;
  return all;
}

void OpennessJudge::see(const OpennessView& view) {
  const detection::WindowObservation& window = view.window;
  const bool is_other = window.target_id != target_id_;
  if (is_other || (!views_.empty() && window.stamp_sec < views_.back().stamp_sec)) reset();
  target_id_ = window.target_id;
  if (!window.whole() || !std::isfinite(window.stamp_sec) || !geometry::isValidPose(view.T_odom_camera) ||
      !geometry::isValidPose(view.T_odom_window) ||
      !(view.opening.width_m > 0.0 && view.opening.height_m > 0.0))
    return;
  if (!agrees(geometry::undistorted(window.corners, &view.camera), view)) return;
  views_.push_back({window.stamp_sec, view.T_odom_camera});
  while (views_.size() > kMaxViews || window.stamp_sec - views_.front().stamp_sec > kLongest_sec)
    views_.pop_front();
  if (window.interior.empty()) return;
  const double key_sec = window.interior.key_stamp_sec;
  if (std::abs(key_sec - evidence_.keyStamp()) > kSameStamp_sec) {  // the next stretch
    past_ = counted();
    estimate_ = KeyframeEstimate();
    evidence_.begin(key_sec);
  }
  const auto key = std::find_if(views_.begin(), views_.end(), [&](const View& earlier) {
    return std::abs(earlier.stamp_sec - key_sec) < kSameStamp_sec;
  });
  if (key != views_.end() && window.stamp_sec > key_sec) compare(view, key->T_odom_camera);
  conclude();
}

void OpennessJudge::compare(const OpennessView& view, const Eigen::Isometry3d& T_odom_camera_key) {
  const auto& [window, camera, T_odom_camera, T_odom_window, opening] = view;
  opening_ = opening;
  const SeenBorder key{geometry::undistorted(window.interior.key_corners, &camera),
                       window.interior.key_covariance};
  const SeenBorder now{geometry::undistorted(window.corners, &camera), window.corner_covariance};
  const auto pair = PlaneParallax::between(camera, key, now, T_odom_camera_key.inverse() * T_odom_window,
                                           T_odom_camera.inverse() * T_odom_window,
                                           {kBorderSigma_px, kPositionSigma_m, window.interior.sigma_px});
  if (!pair || pair->baselineM() < kMinBaseline_m) return;
  const Eigen::Vector3d eye = T_odom_window.inverse() * T_odom_camera.translation();
  for (const detection::InteriorPoint& point : window.interior.points) {
    const auto parallax =
        pair->of(camera.undistort(point.key_px), camera.undistort(point.now_px), point.normal);
    if (!parallax) continue;
    const bool through = passesReveal(parallax->place, eye, opening, params_.reveal_depth_m);
    evidence_.see(point.id, *parallax, through, point.beside);
  }
  estimate_ = evidence_.estimate(pair->distanceM(), params_, cells_);
}

void OpennessJudge::conclude() {
  const Count all = counted();
  const OpeningCells::Share share = cells_.shareOf(needed_, opening_);
  verdict_.openness = Openness::kUnknown;
  verdict_.log_odds = all.log_odds;
  verdict_.open_share = share.open;
  verdict_.points = estimate_.points;
  verdict_.stretches = all.open + all.closed;
  if (estimate_.depth_sigma_m > 0.0) {
    verdict_.has_depth = true;
    verdict_.depth_behind_m = estimate_.depth_m;
    verdict_.depth_sigma_m = estimate_.depth_sigma_m;
  }
  const bool sure_open =
      all.log_odds >= params_.sure_log_odds && all.open >= kOutvoted * all.closed + 2 * all.moving;
  const bool sure_closed = all.log_odds <= -params_.sure_log_odds && all.closed >= kOutvoted * all.open;
  const bool most_moves = estimate_.unsteady > estimate_.points;
  // A stretch with an uncertain depth revokes nothing.
  const bool may_be_a_room = estimate_.depth_m - estimate_.depth_sigma_m < params_.max_depth_behind_m;
  if (sure_closed) {
    verdict_.openness = Openness::kClosed;
    verdict_.reason = formatted("the surface within the border moves with it: %.2f +- %.2f m behind it",
                                verdict_.depth_behind_m, verdict_.depth_sigma_m);
  } else if (estimate_.is_moving && (most_moves || !sure_open)) {
    verdict_.reason = formatted("%d of %d points do not move like a static scene", estimate_.unsteady,
                                estimate_.unsteady + estimate_.points);
  } else if (estimate_.is_too_deep && !(sure_open && may_be_a_room)) {
    verdict_.reason =
        formatted("deeper than a room: %.1f m; a mirror looks the same", verdict_.depth_behind_m);
  } else if (all.open > 0 && all.closed > 0 && !sure_open) {
    verdict_.reason = formatted("%d stretches of the flight say open, %d closed", all.open, all.closed);
  } else if (all.moving > 0 && !sure_open) {
    verdict_.reason =
        formatted("something moved on %d stretches of the flight, log odds %.1f", all.moving, all.log_odds);
  } else if (!sure_open) {
    verdict_.reason = formatted("%d points followed, log odds %.1f", estimate_.points, all.log_odds);
  } else if (share.closed > kMaxClosed) {
    verdict_.reason =
        formatted("partly closed: %.0f %% of the middle, %.0f %% open", 100 * share.closed, 100 * share.open);
  } else if (share.open < kMinOpen || share.least_quarter_open < kMinQuarter ||
             share.least_side_open < kMinSide) {
    verdict_.reason =
        formatted("open as far as seen, but only %.0f %% of the middle was seen", 100 * share.open);
  } else {
    verdict_.openness = Openness::kOpen;
    verdict_.reason = formatted("the scene within the border lies %.1f +- %.1f m behind it",
                                verdict_.depth_behind_m, verdict_.depth_sigma_m);
  }
}

}  // namespace window_ingress::openness
