#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "detection/alignment/ring_model.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// A number of each channel, blue, green and red, worked out at once; the fourth is not used.
using Channels = float __attribute__((vector_size(16)));

/// What the image shows of a stretch of the ring in which the light is even.
struct RingSegment {
  int begin = 0, end = 0;
  float seen = 0.0F;             ///< sum of the samples' weights
  Channels ring_mean{}, mean{};  ///< of the ring's values and of the image's
  float xx = 0.0F, gain = 0.0F;  ///< variance of the ring times its samples, noise added; of all channels
  float noise = 0.0F;            ///< part of `xx`
  double alike = 0.0;            ///< correlation times `weight`
  double weight = 0.0;  ///< what it can tell: that grows with its samples, and slowly with their contrast, so
                        ///< that one strong edge does not stand for all
  double covered_weight = 0.0;  ///< what it could tell more if nothing stood before it
};

/// Weighted mean of the segments' correlations.
struct RingCorrelation {
  double alike = 0.0, most = 0.0;
  void add(const RingSegment& segment) { alike += segment.alike, most += segment.weight; }
  double value() const { return most > 0.0 ? alike / most : -1.0; }
};

/// What a segment says, times its weight.
struct WeightedPart {
  double sum, weight;
};

/// Weighted mean without the third that says least: something may stand before it. Sorts the parts; none may
/// be without weight.
double meanUncovered(std::vector<WeightedPart>& parts);

/// The image under the samples of the ring, at one place and resolution. Keeps its memory.
class RingView {
 public:
  static constexpr double kMinSeen = 0.3;  ///< part of the ring that must lie in the image
  static constexpr int kCoverPasses = 3;   ///< of `coverOutliers`, at a new place
  static constexpr float kNoise = 0.01F;   ///< of a logarithm of a colour

  /// \param model, image outlive the view \param camera null: the image is taken as free of distortion
  /// \param covered something stands before the ring: wherever the view looks, `coverOutliers` follows
  void set(const RingModel& model, const cv::Mat& image, const geometry::PinholeCamera* camera, bool covered);
  bool covered() const { return covered_; }
  const geometry::PinholeCamera* lens() const { return lens_; }  ///< null: no distortion

  /// One resolution of model and image.
  struct Scale {
    const RingLevel* ring;
    const cv::Mat* image;
    int level;
  };
  Scale scaleFor(double quad_side_px, double wanted_px);

  /// Looks at this place, which stays until the next look. \param map from the opening, its sides of length 1
  /// and its centre at 0, to ideal pixels \param nearby the last look was near here, at this scale: what was
  /// covered still is \return part of the ring that lies in the image
  double look(const Scale& scale, const Eigen::Matrix3d& map, bool nearby = false);
  /// The same. \param quad pixels of the image as it came \param side_px resolution, at most [px a mean side]
  double look(const geometry::Quadrilateral& quad, double side_px);

  const RingModel& model() const { return *model_; }
  const RingLevel& ring() const { return *ring_; }

  float meanLog() const;  ///< of the colours that are seen

  /// How much a sample counts; 0 where it lies beside the image.
  float weight(std::size_t i) const { return weights_[i]; }
  const float* weights() const { return weights_.data(); }

  /// Samples that differ from the reference far more than most count less from now on: where most of the ring
  /// fits well, what does not is something before it; where nothing fits, all counts.
  void coverOutliers(int passes);

  /// What one segment shows of the reference, channel by channel and in all.
  RingSegment segment(int s) const;

  /// What is left over of its samples when gain and offsets are taken off. \param residuals as the values of
  /// the ring
  void leaveOver(const RingSegment& segment, std::vector<float>& residuals) const;

  /// Standard deviation of what is left over, from its median; `before` where nothing is seen.
  /// \param residuals as the values of the ring
  float spreadOf(const std::vector<float>& residuals, float before);

 private:
  void place(const Eigen::Matrix3d& map, int level);
  int readPixels(const cv::Mat& image, bool keeps_weights);
  void weighByResiduals();

  const RingModel* model_ = nullptr;
  const geometry::PinholeCamera* lens_ = nullptr;
  ImagePyramid pyramid_;
  const RingLevel* ring_ = nullptr;
  bool covered_ = false;
  std::vector<float> at_x_, at_y_;  ///< the ring's samples on the image's level
  std::vector<float> values_, weights_, residuals_, scratch_;
};

/// Weight of a sample by its squared residual: a scale of the robust weights of Cauchy, in standard
/// deviations.
inline float robustFactor(float spread) {
  constexpr float kOutlier = 2.0F;
  return 1.0F / (kOutlier * spread * kOutlier * spread);
}

/// From the opening, its sides of length 1 and its centre at 0, to a quadrilateral.
Eigen::Matrix3d mapFromCentre(const geometry::Quadrilateral& quad);

}  // namespace window_ingress::detection
