#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "detection/candidates/candidate.hpp"
#include "detection/reference/reference_judge.hpp"
#include "window_ingress/detection/border_refinement.hpp"
#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// Chooses the target among the scored candidates: the best one without an objection whose borders can be
/// fitted. Records the outcome for each candidate in the trace.
class TargetChoice {
 public:
  /// \param reference, trace must outlive this object
  TargetChoice(const DetectorParams& params, ReferenceJudge& reference, DetectionTrace& trace)
      : params_(params), reference_(reference), trace_(trace) {}

  struct View {
    const cv::Mat& image;
    double stamp_sec;
    const geometry::PinholeCamera* camera;  ///< may be null
  };
  using IsWanted = std::function<bool(const geometry::Quadrilateral&)>;

  /// The reference's judge must see the same image. \param candidates are sorted here \param search_factor
  /// image pixels per pixel of the search level
  std::optional<WindowObservation> choose(std::vector<ScoredCandidate>& candidates, int search_factor,
                                          const View& view);

  /// See `WindowDetector::passedOver`.
  std::optional<WindowObservation> passedOver(const WindowObservation& better, const IsWanted& is_wanted,
                                              const View& view) const;

  /// Correlation of the last chosen window's surroundings with the reference's; 0 if they do not fit.
  double ringThere() const { return ring_there_; }

  /// Makes this line of the trace the target instead of the last chosen one, which is at the same place.
  void chooseAgain(int target);
  /// Rejects the last chosen window, because its surroundings do not resemble the reference's at all.
  void takeBack();

  /// Borders of a window near this place: the fit of the reference's surroundings, averaged with the visible
  /// borders. Nothing without a camera, or where the surroundings do not fit.
  std::optional<RefinedBorders> bordersNear(const geometry::Quadrilateral& place, const View& view) const;

 private:
  std::optional<Rejection> objection(const ScoredCandidate& candidate) const;
  std::optional<RefinedBorders> refine(const ScoredCandidate& candidate, const View& view,
                                       double& inliers) const;
  std::optional<RefinedBorders> fitWhere(const AlignedRing& ring, const View& view) const;
  std::optional<Rejection> fit(const ScoredCandidate& candidate, const View& view, RefinedBorders& fitted);
  std::optional<Rejection> judgeSurroundingsOf(const ScoredCandidate& candidate, const View& view,
                                               RefinedBorders& fitted);
  void uncover(const View& view, RefinedBorders& fitted);
  bool showsOpening(const ScoredCandidate& candidate, const RefinedBorders& found) const;
  double leastScore(const ScoredCandidate& candidate) const;
  void record(const ScoredCandidate& candidate, RejectReason reason, double value, double limit) {
    trace_.candidates.push_back(traceOf(candidate, {reason, value, limit}));
  }

  DetectorParams params_;
  ReferenceJudge& reference_;
  DetectionTrace& trace_;
  int search_factor_ = 1;
  double ring_there_ = 0.0;
};

}  // namespace window_ingress::detection
