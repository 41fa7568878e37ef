#pragma once

#include <vector>

#include "detection/alignment/ring_alignment.hpp"
#include "detection/alignment/ring_search.hpp"
#include "detection/candidates/candidate_search.hpp"

namespace window_ingress::detection {

/// Which rivals have round them what the reference shows round the opening, and where exactly: all are
/// compared, the best are moved to where the ring fits best.
class RingMatcher {
 public:
  /// Resolutions at which an alignment begins: of borders that a search found, which may be off by some
  /// pixels, and of borders that are followed [px a mean side].
  static constexpr double kFoundStartPx = 30.0, kFollowedStartPx = 100.0;

  /// See RingModel.
  void learn(const cv::Mat& image, const geometry::Quadrilateral& opening, double colour = 1.0,
             const std::optional<OpeningAspect>& aspect = std::nullopt, bool framed = false) {
    model_.learn(image, opening, colour);
    model_.setAspect(aspect);
    model_.setFramed(framed);
    search_.forget();
    if (model_.known()) search_.learn(image, opening);
  }
  void forget() { model_.forget(), search_.forget(); }
  bool known() const { return model_.known(); }

  /// From now on something stands before the ring, or nothing does. See RingAlignment.
  void setCovered(bool covered) { covered_ = covered; }

  /// Best first, each place once; the score is the correlation. Valid until the next call. Notes the
  /// correlation of every rival as it is. \param image CV_8UC3
  const std::vector<ScoredCandidate>& align(const cv::Mat& image, const geometry::PinholeCamera* camera,
                                            std::vector<ScoredCandidate>& rivals);

  /// Where the ring may be, found without any edge, see RingSearch. \param image as above
  std::vector<ScoredCandidate> placesEverywhere(const cv::Mat& image, bool leaning = true);

  /// Where it fits best near this place; nothing where it does not. \param coarsest_px one of the above
  std::optional<AlignedRing> alignedAt(const cv::Mat& image, const geometry::PinholeCamera* camera,
                                       const geometry::Quadrilateral& quad, double coarsest_px);
  /// How well it fits there, in the image of the last call, also where that is less sharp than the
  /// reference's.
  RingMatch judged(const geometry::Quadrilateral& quad);

  /// See RingAlignment.
  std::optional<AlignedRing> uncovered(const cv::Mat& image, const geometry::PinholeCamera* camera,
                                       const geometry::Quadrilateral& quad);
  std::optional<geometry::Quadrilateral> completed(const geometry::Quadrilateral& quad, int side) const {
    return alignment_.completed(quad, side);
  }

 private:
  bool compares(const cv::Mat& image) const { return known() && image.channels() == kRingChannels; }
  std::optional<ScoredCandidate> aligned(const ScoredCandidate& rough, double finest_px);
  void keep(const ScoredCandidate& rival);
  void compareAll(std::vector<ScoredCandidate>& rivals);

  RingModel model_;
  RingAlignment alignment_;
  RingSearch search_;
  bool covered_ = false;
  std::vector<std::pair<double, std::size_t>>
      order_;  ///< by correlation before anything is moved; of `rivals`
  std::vector<ScoredCandidate> aligned_;
};

}  // namespace window_ingress::detection
