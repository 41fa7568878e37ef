#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "detection/alignment/ring_matcher.hpp"
#include "detection/candidates/candidate_gates.hpp"
#include "detection/candidates/candidate_search.hpp"
#include "detection/reference/frame_ends.hpp"
#include "detection/reference/reference_borders.hpp"
#include "detection/reference/reference_shape.hpp"
#include "detection/reference/ring_histogram.hpp"
#include "window_ingress/detection/border_refinement.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/reference_appearance.hpp"

namespace window_ingress::detection {

/// Which of the rivals is the target that the reference shows (P9): where its borders are, how far its
/// colours and its shape are those of the reference.
class ReferenceJudge {
 public:
  explicit ReferenceJudge(const DetectorParams& params);

  /// \param reference null: none
  void learn(std::shared_ptr<const ReferenceAppearance> reference);
  const std::shared_ptr<const ReferenceAppearance>& reference() const { return reference_; }

  /// True if rivals can be told apart by the colours about their borders.
  bool knowsBorders() const { return borders_.known(); }

  /// True if the reference shows no frame.
  bool frameless() const { return borders_.frameless(); }

  /// Colour of the reference's frame, see `RingMeans::paint`; nothing where it has none.
  std::optional<Eigen::Vector3f> paint() const;

  /// True if what lies round the reference's opening can be compared with the image.
  bool knowsSurroundings(const cv::Mat& image) const { return compares(image) && ring_.known(); }

  /// False if there is no reference or only one of reference and image has colours.
  bool compares(const cv::Mat& image) const;

  /// Weighs the rivals by their frames; adds those whose borders it located. False, and nothing changed, if
  /// they cannot be compared.
  bool judgeFrames(const cv::Mat& image, const geometry::PinholeCamera* camera,
                   std::vector<ScoredCandidate>& rivals);

  /// Adds the places that have round them what lies round the reference's opening; no other rival may be the
  /// target then. False, and nothing changed, if they cannot be compared.
  bool judgeSurroundings(const cv::Mat& image, const geometry::PinholeCamera* camera,
                         std::vector<ScoredCandidate>& rivals);

  /// From now on something stands before what lies round the opening, or nothing does.
  void setCovered(bool covered) { covered_ = covered, ring_.setCovered(covered); }

  /// Rivals for that from the whole image, without any edge; none if it cannot be compared.
  std::vector<ScoredCandidate> placesEverywhere(const cv::Mat& image);

  /// True if the colours of a frame may tell the target alone, whatever lies round it: they are found nowhere
  /// else in the reference, and its borders here are surely the reference's; or nothing else is known.
  /// \param worth of the borders, see ScoredCandidate
  bool frameTells(const cv::Mat& image, double worth) const;

  /// How many borders must show where this fits: the fewer, the less anything else can be like it.
  int bordersNeeded(const RingMatch& match) const;

  /// Why the colours of a frame are not the reference's (P9).
  std::optional<Rejection> objectionTo(const AppearanceMatch& match) const;

  /// Why what lies round a place is not what lies round the reference's opening.
  /// \param frame its colours, where they can be compared
  std::optional<Rejection> objectionTo(const RingMatch& match,
                                       const std::optional<AppearanceMatch>& frame) const;

  /// Where what lies round a window near this place fits best; nothing where there is something else behind
  /// its frame, as behind a gate. \param coarsest_px see RingMatcher
  std::optional<AlignedRing> surroundingsOf(const geometry::Quadrilateral& corners, const cv::Mat& image,
                                            const geometry::PinholeCamera* camera, double coarsest_px);

  /// See RingAlignment.
  std::optional<AlignedRing> uncovered(const geometry::Quadrilateral& corners, const cv::Mat& image,
                                       const geometry::PinholeCamera* camera);
  std::optional<geometry::Quadrilateral> completed(const geometry::Quadrilateral& corners, int side) const {
    return ring_.completed(corners, side);
  }

  /// The same of surroundings that `surroundingsOf` found last; haze that took their contrasts is none.
  std::optional<Rejection> objectionTo(const AlignedRing& ring, const cv::Mat& image,
                                       const std::optional<AppearanceMatch>& frame);

  /// True if what lies within three of the borders, or as many as in the reference, differs from the wall
  /// without: a wall whose pattern repeats itself looks like that round the opening elsewhere, too, but goes
  /// on within.
  bool showsOpening(const cv::Mat& image, const geometry::Quadrilateral& corners,
                    const geometry::PinholeCamera* camera);

  /// True if a frame beside one of the sides is seen beyond its end, too, as it is not in the reference:
  /// three sides are those of a larger window.
  bool frameGoesOn(const cv::Mat& image, const geometry::Quadrilateral& corners,
                   const geometry::PinholeCamera* camera);

  /// Why fitted borders cannot be the reference's, if they cannot.
  std::optional<Rejection> objectionTo(const RefinedBorders& fitted, const cv::Mat& image,
                                       const geometry::PinholeCamera* camera);

 private:
  int openBorders(const cv::Mat& image, const geometry::Quadrilateral& corners,
                  const geometry::PinholeCamera* camera);
  bool hasOwnFrame() const;
  double sureCorrelation() const;
  bool isHazy(const cv::Mat& image, const geometry::Quadrilateral& corners, const RingMatch& match) const;
  const cv::Mat& inChannels(const cv::Mat& image);
  std::optional<ScoredCandidate> locate(const cv::Mat& image, const geometry::PinholeCamera* camera,
                                        const ScoredCandidate& rough, const ReferenceBorders::Effort& effort);
  void locateAll(const cv::Mat& image, const geometry::PinholeCamera* camera,
                 const std::vector<ScoredCandidate>& rivals);
  bool weigh(const cv::Mat& image, std::vector<ScoredCandidate>& rivals) const;
  void weighOthers(const cv::Mat& image, std::vector<ScoredCandidate>& rivals) const;

  AppearanceParams appearance_;
  double min_correlation_;
  ReferenceBorders borders_;
  RingMatcher ring_;
  ReferenceShape shape_;
  std::shared_ptr<const ReferenceAppearance> reference_;
  std::optional<RingColours> frame_colours_;  ///< of the reference
  int open_borders_ = 4;  ///< of the reference: within them something else is seen than without
  FrameEnds beyond_{};    ///< in the reference
  bool covered_ = false;
  bool is_grey_ = false;  ///< the reference; then by brightness alone
  cv::Mat channels_;
  std::array<SideProfile, 4> sides_;
  std::vector<std::size_t> places_;  ///< of the rivals that are looked at
  std::vector<ScoredCandidate> located_;
};

}  // namespace window_ingress::detection
