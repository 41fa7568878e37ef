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

  /// Sets the image that all calls below are about. The ring must be known.
  /// \param image CV_8UC3; must outlive these calls, as must `camera`
  void see(const cv::Mat& image, const geometry::PinholeCamera* camera) {
    image_ = image;
    alignment_.set(model_, image_, camera);
  }

  /// Sets whether something stands before the ring. See RingAlignment.
  void setCovered(bool covered) { covered_ = covered, alignment_.setCovered(covered); }

  /// Aligned candidates, best first, each place once; the score combines the correlations. Stores the
  /// correlation of every candidate before its alignment.
  std::vector<ScoredCandidate> align(std::vector<ScoredCandidate>& candidates);

  /// Places where the ring may be, found without edges, see RingSearch.
  std::vector<ScoredCandidate> placesEverywhere(bool leaning = true);

  /// Best fit of the ring near this place; nothing where it does not fit.
  /// \param coarsest_px one of the above
  std::optional<AlignedRing> alignedAt(const geometry::Quadrilateral& quad, double coarsest_px) {
    return alignment_.align(quad, kFinestPx, coarsest_px);
  }
  /// Fit of the ring there; also for an image that is less sharp than the reference.
  RingMatch judged(const geometry::Quadrilateral& quad);

  /// See RingAlignment.
  std::optional<AlignedRing> uncovered(const geometry::Quadrilateral& quad) {
    return alignment_.uncovered(quad, kFinestPx);
  }
  std::optional<geometry::Quadrilateral> completed(const geometry::Quadrilateral& quad, int side) const {
    return alignment_.completed(quad, side);
  }

 private:
  static constexpr double kFinestPx = 200.0;  ///< last resolution of an alignment [px per mean side]

  struct Promise {
    double score;       ///< correlation before alignment, with some of the score by geometry
    std::size_t index;  ///< of the candidate
  };
  std::vector<Promise> compareAll(std::vector<ScoredCandidate>& candidates);
  std::optional<ScoredCandidate> aligned(const ScoredCandidate& rough, double finest_px);

  RingModel model_;
  RingAlignment alignment_;
  RingSearch search_;
  cv::Mat image_;
  bool covered_ = false;
};

}  // namespace window_ingress::detection
