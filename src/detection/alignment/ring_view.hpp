#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "detection/alignment/ring_model.hpp"
#include "detection/image_pyramid.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// One number per channel (blue, green, red), computed together; the fourth is unused.
using Channels = float __attribute__((vector_size(16)));

/// Statistics of the image over a stretch of the ring with even light.
struct RingSegment {
  int begin = 0, end = 0;
  float seen = 0.0F;             ///< sum of the samples' weights
  Channels ring_mean{}, mean{};  ///< of the ring's values and of the image's
  float xx = 0.0F, gain = 0.0F;  ///< variance of the ring times number of samples, with noise; all channels
  float noise = 0.0F;            ///< part of `xx`
  double alike = 0.0;            ///< correlation times `weight`
  /// Information: grows with the samples, and slowly with their contrast, so that no strong edge dominates.
  double weight = 0.0;
  double covered_weight = 0.0;  ///< weight it would gain if nothing stood before it
};

/// Values times their weights, and the weights.
struct WeightedSum {
  double sum = 0.0, weight = 0.0;
  double mean() const { return weight > 0.0 ? sum / weight : -1.0; }
};

/// Correlation of segments with the reference.
WeightedSum correlationOf(const std::vector<RingSegment>& segments);

/// Adds a value of this segment times its weight to the parts, and one for what is covered of it.
void addParts(double value, const RingSegment& segment, std::vector<WeightedSum>& parts);

/// Weighted mean without the worst third, which may be covered. Sorts the parts. Every part must have a
/// positive weight.
double meanUncovered(std::vector<WeightedSum>& parts);

/// The image at the ring's samples, at one place and resolution. Keeps its memory.
class RingView {
 public:
  static constexpr double kMinSeen = 0.3;  ///< part of the ring that must lie in the image
  static constexpr int kCoverPasses = 3;   ///< of `coverOutliers` at a new place
  static constexpr float kNoise = 0.01F;   ///< of a logarithm of a colour

  /// \param model, image must outlive the view \param camera null: the image has no distortion
  void set(const RingModel& model, const cv::Mat& image, const geometry::PinholeCamera* camera);
  /// Sets whether something stands before the ring: every `look` then includes `coverOutliers`.
  void setCovered(bool covered) { covered_ = covered; }
  bool covered() const { return covered_; }
  const geometry::PinholeCamera* lens() const { return lens_; }  ///< null: no distortion

  /// One resolution of model and image.
  struct Scale {
    const RingLevel* ring;
    const cv::Mat* image;
    int level;
  };
  Scale scaleFor(double quad_side_px, double wanted_px);

  /// Moves the view to this place. \param map from the opening, scaled to unit sides and centred at 0, to
  /// undistorted pixels \param nearby the last look was near here, at this scale: its covered samples stay
  /// covered \return part of the ring that lies in the image
  double look(const Scale& scale, const Eigen::Matrix3d& map, bool nearby = false);
  /// As above. \param quad pixels of the raw image \param side_px resolution, at most [px per mean side]
  double look(const geometry::Quadrilateral& quad, double side_px);

  const RingModel& model() const { return *model_; }
  const RingLevel& ring() const { return *ring_; }
  const std::vector<RingSegment>& segments();               ///< until the next call
  float meanLog() const;                                    ///< mean over the visible samples
  const float* weights() const { return weights_.data(); }  ///< of the samples; 0 outside the image

  /// Lowers the weight of samples that differ from the reference far more than most. Where most of the ring
  /// fits well, the rest is covered; where nothing fits, all samples count.
  void coverOutliers(int passes);

  /// Residuals of the segment's samples after removal of gain and offsets. \param residuals laid out as the
  /// ring's values
  void leaveOver(const RingSegment& segment, std::vector<float>& residuals) const;

  /// Standard deviation of the residuals, from their median; `before` where nothing is visible.
  /// \param residuals laid out as the ring's values
  float spreadOf(const std::vector<float>& residuals, float before);

 private:
  RingSegment segment(int s) const;
  void place(const Eigen::Matrix3d& map, int level);
  int readPixels(const cv::Mat& image, bool keeps_weights);

  const RingModel* model_ = nullptr;
  const geometry::PinholeCamera* lens_ = nullptr;
  ImagePyramid pyramid_;
  const RingLevel* ring_ = nullptr;
  bool covered_ = false;
  std::vector<float> at_x_, at_y_;  ///< the ring's samples on the image's level
  std::vector<float> values_, weights_, residuals_, scratch_;
  std::vector<RingSegment> segments_;
};

/// Scale of the robust Cauchy weight 1 / (1 + factor * residual^2), for residuals of this standard deviation.
inline float robustFactor(float spread) {
  constexpr float kOutlier = 2.0F;
  return 1.0F / (kOutlier * spread * kOutlier * spread);
}

/// Map from the opening, scaled to unit sides and centred at 0, to a quadrilateral.
Eigen::Matrix3d mapFromCentre(const geometry::Quadrilateral& quad);

}  // namespace window_ingress::detection
