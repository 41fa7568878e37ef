#pragma once

#include <vector>

#include "detection/alignment/ring_alignment.hpp"
#include "detection/alignment/ring_search.hpp"
#include "detection/candidates/candidate.hpp"

namespace window_ingress::detection {

/// Finds the candidates whose surroundings match the reference's, and their exact position: compares all
/// candidates, then moves the best to where the ring fits best.
class RingMatcher {
 public:
  /// First resolution of an alignment [px per mean side]: for borders from a search, which may be off by some
  /// pixels, and for tracked borders.
  static constexpr double kFoundStartPx = 30.0, kFollowedStartPx = 100.0;

  /// See RingModel.
  void learn(const cv::Mat& image, const geometry::Quadrilateral& opening, float colour = 1.0F,
             const std::optional<OpeningAspect>& aspect = std::nullopt, bool framed = false) {
    model_ = {colour, aspect, framed, {}};
    model_.learn(image, opening);
    search_ = {};
    if (known()) search_.learn(image, opening);
  }
  bool known() const { return model_.known(); }

  /// Sets whether something stands before the ring. See RingAlignment.
  void setCovered(bool covered) { covered_ = covered; }

  /// Aligned candidates, best first, each place once; the score combines the correlations. Stores the
  /// correlation of every candidate before its alignment. \param image CV_8UC3
  std::vector<ScoredCandidate> align(const cv::Mat& image, const geometry::PinholeCamera* camera,
                                     std::vector<ScoredCandidate>& candidates);

  /// Places where the ring may be, found without edges, see RingSearch. \param image CV_8UC3
  std::vector<ScoredCandidate> placesEverywhere(const cv::Mat& image, bool leaning = true);

  /// Best fit of the ring near this place; nothing where it does not fit. The ring must be known.
  /// \param coarsest_px one of the above
  std::optional<AlignedRing> alignedAt(const cv::Mat& image, const geometry::PinholeCamera* camera,
                                       const geometry::Quadrilateral& quad, double coarsest_px);
  /// Fit of the ring there, in the image of the last call; also for an image that is less sharp than the
  /// reference.
  RingMatch judged(const geometry::Quadrilateral& quad);

  /// See RingAlignment.
  std::optional<AlignedRing> uncovered(const cv::Mat& image, const geometry::PinholeCamera* camera,
                                       const geometry::Quadrilateral& quad);
  std::optional<geometry::Quadrilateral> completed(const geometry::Quadrilateral& quad, int side) const {
    return alignment_.completed(quad, side);
  }

 private:
  struct Promise {
    double score;       ///< correlation before alignment, with some of the score by geometry
    std::size_t index;  ///< of the candidate
  };
  std::vector<Promise> compareAll(std::vector<ScoredCandidate>& candidates);
  std::optional<ScoredCandidate> aligned(const ScoredCandidate& rough, double finest_px);

  RingModel model_;
  RingAlignment alignment_;
  RingSearch search_;
  bool covered_ = false;
};

}  // namespace window_ingress::detection
