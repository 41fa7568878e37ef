#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "detection/candidates/candidate.hpp"
#include "detection/candidates/canny_edges.hpp"
#include "detection/candidates/contour_polygons.hpp"
#include "detection/candidates/edge_chains.hpp"
#include "detection/candidates/hough_segments.hpp"
#include "detection/candidates/preprocess.hpp"
#include "detection/candidates/segment_quads.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/reference_appearance.hpp"
#include "window_ingress/detection/stage_timer.hpp"

namespace window_ingress::detection {

/// The first half of the detector, on the search level: image to candidates that passed the gates (P2 to P8).
class CandidateSearch {
 public:
  explicit CandidateSearch(const DetectorParams& params);

  /// Candidates, best first, each loop once, at most `max_candidates`; valid until the next call. All others
  /// go into the trace. \param image CV_8UC1 or CV_8UC3, at least 16 pixels each way \param camera
  /// calibration of the image, or null: no distortion
  const std::vector<ScoredCandidate>& run(const cv::Mat& image, const geometry::PinholeCamera* camera,
                                          DetectionTrace& trace);

  /// Searches the last image again by its colours alone and by the outlines of blobs: for borders that differ
  /// from their surroundings in hue but not in brightness, or that are lost among brighter and darker things.
  /// None if it has no colours. \param paint colour of a thin or blurred frame, if known: searches by that
  /// alone, see `RingMeans::paint`
  const std::vector<ScoredCandidate>& runOnColours(const std::optional<Eigen::Vector3f>& paint,
                                                   DetectionTrace& trace);

  /// Result of the last call.
  const std::vector<ScoredCandidate>& kept() const { return kept_; }

  /// Quadrilaterals enclosed by three sides of the last call, see SegmentQuads::open. By geometry alone they
  /// are no windows; the caller must judge them.
  std::vector<ScoredCandidate> open();

  /// \param timer is notified of each completed stage; null: none; must outlive this object
  void setTimer(StageTimer* timer) { timer_ = timer; }

  int factor() const { return level_.factor; }  ///< pixels of the last image per pixel of its search level

 private:
  void look(const cv::Mat& image);
  void outline(const cv::Mat& mask, CandidateSource source);
  const std::vector<ScoredCandidate>& combine(const SegmentQuads::Effort& effort, DetectionTrace& trace);
  const geometry::PinholeCamera* lens() const { return lens_ ? &*lens_ : nullptr; }
  ScoredCandidate placed(const Candidate& found) const;
  void admit(const Candidate& found, DetectionTrace& trace);
  void keepBest(DetectionTrace& trace);

  DetectorParams params_;
  SearchLevel level_;
  std::optional<geometry::PinholeCamera> lens_;  ///< of the search level
  EdgeMap map_;
  cv::Mat straight_, closed_;  // edges on segments; with their gaps closed
  EdgeChains chains_;
  HoughSegments hough_;
  SegmentQuads segment_quads_;
  const std::vector<Segment>* segments_ = nullptr;
  Outlines outlines_;
  std::vector<ScoredCandidate> admitted_, kept_;
  StageTimer* timer_ = nullptr;
};

}  // namespace window_ingress::detection
