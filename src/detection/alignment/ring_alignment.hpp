#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "detection/alignment/homography_sums.hpp"
#include "detection/alignment/rectangle_prior.hpp"
#include "detection/alignment/ring_score.hpp"
#include "detection/alignment/ring_view.hpp"
#include "window_ingress/detection/border_refinement.hpp"

namespace window_ingress::detection {

/// Where the ring fits best.
struct AlignedRing {
  geometry::Quadrilateral quad;  ///< order as the start, pixels of the raw image
  double correlation;            ///< see RingMatch
  /// Uncertainty of the sides, in the same order. A side is unknown if the camera sees its frame from beyond
  /// it, or if less than half of the ring beside it is in the image.
  std::array<SideSigma, 4> sides;
  std::optional<int> hidden;  ///< covered side, known only through the three others
};

/// Compares the reference's ring with places in an image, and moves a quadrilateral to where the ring fits
/// best: Gauss-Newton on the homography, inverse compositional, coarse to fine, with robust weights. Each
/// segment of the ring has its own gain, and its own offset per channel, so exposure, white balance and cast
/// shadows have no effect. Keeps its memory; use one object per thread.
class RingAlignment {
 public:
  /// \param model, image must outlive the comparisons \param camera null: the image has no distortion
  void set(const RingModel& model, const cv::Mat& image, const geometry::PinholeCamera* camera);

  /// Sets whether something stands before the ring: samples that do not fit are then left out from the start.
  void setCovered(bool covered) { view_.setCovered(covered); }

  /// \param side_px resolution of the comparison, at most [px per mean side]
  double correlation(const geometry::Quadrilateral& quad, double side_px);

  /// As `correlation`, also where something stands before the ring: samples that differ far more than most
  /// count less. Dark images are compared at half the resolution, which averages the noise.
  RingMatch judge(const geometry::Quadrilateral& quad, double side_px);

  /// Nothing if the alignment runs away from the start. \param finest_px, coarsest_px last and first
  /// resolution: a coarser first one tolerates a start that is further off
  std::optional<AlignedRing> align(const geometry::Quadrilateral& start, double finest_px,
                                   double coarsest_px);

  /// Realigns the ring without one side, where `quad` is no view of the opening because the edge of an object
  /// before that side was mistaken for its border. Nothing where all sides fit, or where this does not help.
  std::optional<AlignedRing> uncovered(const geometry::Quadrilateral& quad, double finest_px);

  /// The quadrilateral with this side placed from the others; nothing where the opening's shape is unknown.
  /// \param quad pixels of the raw image, order as the reference's
  std::optional<geometry::Quadrilateral> completed(const geometry::Quadrilateral& quad, int side) const;

 private:
  /// Weighted products of the samples' slopes (a, b), residuals r and ring values x, summed over all
  /// channels; and the weighted slopes of each channel.
  struct SlopeProducts {
    static constexpr int kMost = 32;
    using Each = std::array<float, kMost>;
    Each aa{}, ab{}, bb{}, ar{}, br{}, ax{}, bx{};
    std::array<Each, kRingChannels> a, b;
  };
  SlopeProducts products(const RingSegment& segment, int begin, int count) const;
  void accumulate(const RingSegment& segment, NormalSum& normal, DerivativeSum& right, Matrix8f& explained);
  double beyondChance(double correlation) const;
  double partInView(int side) const;
  double fit();
  std::optional<int> hiddenSide();
  std::optional<Eigen::Matrix3d> change(const Eigen::Matrix3d& map);
  double refine(const RingView::Scale& scale, const geometry::Quadrilateral& start, Eigen::Matrix3d& map,
                int most_steps, const std::optional<int>& hidden = std::nullopt);
  std::optional<AlignedRing> ringAt(const Eigen::Matrix3d& map, double correlation) const;
  std::array<SideSigma, 4> sidesOf(const Eigen::Matrix3d& map) const;

  RingView view_;
  std::optional<RectanglePrior> prior_;
  bool leaves_out_ = false;  ///< covered parts: three sides determine a rectangle of known shape
  std::vector<RingSegment> segments_;
  std::vector<WeightedSum> parts_;
  std::vector<float> residuals_;
  Matrix8f normal_;       ///< of the last change
  Matrix8f information_;  ///< of the best map, from its last change and the residual spread
  float spread_ = 0.1F;   ///< of the residuals
};

}  // namespace window_ingress::detection
