#pragma once

#include <memory>
#include <vector>

#include "detection/alignment/ring_matcher.hpp"
#include "detection/reference/reference_borders.hpp"
#include "detection/reference/reference_shape.hpp"
#include "detection/reference/ring_colours.hpp"
#include "window_ingress/detection/border_refinement.hpp"

namespace window_ingress::detection {

/// Judges which candidate is the target in the reference image (P9), by its borders, colours and shape.
class ReferenceJudge {
 public:
  explicit ReferenceJudge(const DetectorParams& params);

  /// \param reference null: none
  void learn(std::shared_ptr<const ReferenceAppearance> reference);
  const std::shared_ptr<const ReferenceAppearance>& reference() const { return reference_; }

  bool knowsBorders() const { return borders_.known(); }   ///< candidates can be compared by these
  bool frameless() const { return borders_.frameless(); }  ///< the reference shows no frame
  /// Colour of the reference's frame, see `RingMeans::paint`; nothing if it has none.
  std::optional<Eigen::Vector3f> paint() const;

  /// Sets the image that all calls below are about.
  /// \param image CV_8UC1 or CV_8UC3; must outlive these calls, as must `camera` (null: no distortion)
  void see(const cv::Mat& image, const geometry::PinholeCamera* camera);

  /// False without a reference, or if only one of reference and image has colour.
  bool compares() const { return compares_; }
  /// True if the surroundings of the reference's opening can be compared with the image.
  bool knowsSurroundings() const { return compares_ && ring_.known(); }

  /// Weighs the candidates by their frames and adds candidates with located borders. Returns false, and
  /// changes nothing, if they cannot be compared.
  bool judgeFrames(std::vector<ScoredCandidate>& candidates);

  /// Adds the places whose surroundings match the reference's; no other candidate may be the target then.
  /// Returns false, and changes nothing, if they cannot be compared.
  bool judgeSurroundings(std::vector<ScoredCandidate>& candidates);

  /// Sets whether something stands before the opening's surroundings.
  void setCovered(bool covered) { covered_ = covered, ring_.setCovered(covered); }

  /// Candidates for `judgeSurroundings` from the whole image, found without edges; none if it cannot be
  /// compared.
  std::vector<ScoredCandidate> placesEverywhere();

  /// True if the frame's colours alone may identify the target, whatever its surroundings. Its colours must
  /// occur nowhere else in the reference, and its borders must surely match; or nothing else is known.
  /// \param border_score of the borders, see ScoredCandidate
  bool frameTells(double border_score) const;

  /// Number of borders that must be visible with this match: fewer for a match that is harder to mistake.
  int bordersNeeded(const RingMatch& match) const;

  /// Why the colours of a frame are not the reference's (P9).
  std::optional<Rejection> objectionTo(const AppearanceMatch& match) const;

  /// Why the surroundings of a place are not the reference's.
  /// \param frame match of the frame's colours, where they can be compared
  std::optional<Rejection> objectionTo(const RingMatch& match,
                                       const std::optional<AppearanceMatch>& frame) const;

  /// Best fit of the surroundings near this window. Nothing where its background differs, as behind a
  /// free-standing gate. \param coarsest_px see RingMatcher
  std::optional<AlignedRing> surroundingsOf(const geometry::Quadrilateral& corners, double coarsest_px);

  /// See RingAlignment.
  std::optional<AlignedRing> uncovered(const geometry::Quadrilateral& corners);
  std::optional<geometry::Quadrilateral> completed(const geometry::Quadrilateral& corners, int side) const {
    return ring_.completed(corners, side);
  }

  /// Objection to the surroundings that `surroundingsOf` found last. Contrast lost to haze is no objection.
  std::optional<Rejection> objectionTo(const AlignedRing& ring, const std::optional<AppearanceMatch>& frame);

  /// True if the image inside three of the borders, or as many as in the reference, differs from the wall
  /// outside. A wall with a repeating pattern can match the surroundings elsewhere, but there it continues
  /// inside.
  bool showsOpening(const geometry::Quadrilateral& corners);

  /// True if the frame of a side continues beyond the side's end where the reference's does not. Then three
  /// sides belong to a larger window.
  bool frameGoesOn(const geometry::Quadrilateral& corners);

  /// Why fitted borders cannot be the reference's; nothing if they can.
  std::optional<Rejection> objectionTo(const RefinedBorders& fitted);

 private:
  int openBorders(const geometry::Quadrilateral& corners);
  bool hasOwnFrame() const;
  double sureCorrelation() const;
  std::optional<ScoredCandidate> locate(const ScoredCandidate& rough, const ReferenceBorders::Effort& effort);
  std::vector<ScoredCandidate> locateAll(const std::vector<ScoredCandidate>& candidates);
  bool weigh(std::vector<ScoredCandidate>& candidates) const;
  void weighOthers(const std::vector<ScoredCandidate>& located,
                   std::vector<ScoredCandidate>& candidates) const;

  AppearanceParams appearance_;
  double min_correlation_;
  ReferenceBorders borders_;
  RingMatcher ring_;
  ReferenceShape shape_;
  std::shared_ptr<const ReferenceAppearance> reference_;
  std::optional<RingColours> frame_colours_;  ///< of the reference
  int open_borders_ = 0;  ///< borders of the reference whose inside differs from the outside
  FrameEnds beyond_{};    ///< in the reference
  bool covered_ = false;
  bool is_grey_ = false;  ///< the reference is grey: only brightness counts
  bool compares_ = false;
  cv::Mat image_, bgr_, converted_;  ///< as seen; with three channels if it is compared; memory of the latter
  const geometry::PinholeCamera* camera_ = nullptr;
  std::array<SideProfile, 4> sides_;
};

}  // namespace window_ingress::detection
