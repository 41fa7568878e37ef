#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "detection/alignment/homography_sums.hpp"
#include "detection/alignment/rectangle_prior.hpp"
#include "detection/alignment/ring_match.hpp"
#include "detection/alignment/ring_model.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Where the ring fits best.
struct AlignedRing {
  geometry::Quadrilateral quad;  ///< order as the start, pixels of the image as it came
  RingMatch match;
};

/// Compares the reference's ring with places in an image, and moves a quadrilateral to where it fits best:
/// Gauss and Newton on the homography, inverse compositional, coarse to fine, with robust weights. A segment
/// of the ring has a gain and, channel by channel, an offset of its own: exposure, white balance and cast
/// shadows change nothing. Keeps its memory; one object a thread.
class RingAlignment {
 public:
  /// \param model, image outlive the comparisons \param camera null: the image is taken as free of
  /// distortion, and any homography as possible
  void set(const RingModel& model, const cv::Mat& image, const geometry::PinholeCamera* camera);

  /// \param side_px resolution at which they are compared, at most [px a mean side]
  RingMatch compare(const geometry::Quadrilateral& quad, double side_px);

  /// The same, and what it says where something stands before the ring: samples that differ far more than
  /// most count less.
  RingMatch judge(const geometry::Quadrilateral& quad, double side_px);

  /// Nothing if it runs away from the start. \param finest_px as `side_px`
  std::optional<AlignedRing> align(const geometry::Quadrilateral& start, double finest_px);

 private:
  /// Weighted moments of ring (x) and image (y) over one segment and one channel.
  struct Moments {
    float n = 0.0F, x = 0.0F, y = 0.0F, xx = 0.0F, yy = 0.0F, xy = 0.0F;

    float meanX() const { return n > 0.0F ? x / n : 0.0F; }
    float meanY() const { return n > 0.0F ? y / n : 0.0F; }
    float varX() const { return std::max(0.0F, xx - x * meanX()); }
    float varY() const { return std::max(0.0F, yy - y * meanY()); }
    float cov() const { return xy - x * meanY(); }
  };
  static Moments momentsOf(const float* ring, const float* picture, const float* weights, int begin, int end);

  /// A stretch of the ring in which the light is even.
  struct Segment {
    int begin, end;
    std::array<Moments, 3> moments;  ///< of the channels
    float xx, gain;                  ///< variance of the ring times its samples, noise added; of all channels
    float noise;                     ///< part of `xx`
  };

  /// What a segment adds to the likeness of its weight, and with which contrast, beside the reference's.
  struct Share {
    double alike, weight, gain, variance;  ///< variance: of the logarithm of the gain
    double faithful;                       ///< of `alike`
  };

  /// Mean of the segments' correlations, each weighed by what it can tell: that grows with its samples, and
  /// slowly with their contrast, so that one strong edge does not stand for all.
  struct CorrelationSum {
    double alike = 0.0, most = 0.0;
    void add(float samples, float xx, float yy, float xy);
    double correlation() const { return most > 0.0 ? alike / most : -1.0; }
  };

  /// One resolution of model and image.
  struct Scale {
    const RingLevel* ring;
    const cv::Mat* picture;
    int level;
  };
  Scale scaleFor(double quad_side_px, double wanted_px);
  double read(const Scale& scale, const Eigen::Matrix3d& map);
  void weigh(int count);
  void place(const Scale& scale, const Eigen::Matrix3d& map);
  template <int kChannels>
  int readPixels(const cv::Mat& picture);
  void coverOutliers(const RingLevel& ring);
  void shareOut(const RingLevel& ring);
  double weighContrasts();
  double uncovered(double Share::*part);
  Segment measure(const RingLevel& ring, int s);
  void accumulate(const RingLevel& ring, const Segment& segment, NormalSum& normal, DerivativeSum& right,
                  Matrix8f& explained);
  std::optional<Eigen::Matrix3d> change(const RingLevel& ring, const Eigen::Matrix3d& map);
  RingMatch refine(const Scale& scale, const geometry::Quadrilateral& start, Eigen::Matrix3d& map,
                   int most_steps);

  const RingModel* model_ = nullptr;
  const geometry::PinholeCamera* lens_ = nullptr;
  std::optional<RectanglePrior> prior_;
  ImagePyramid pyramid_;
  int channels_ = 0;
  std::vector<float> at_x_, at_y_;  ///< the ring's samples on the image's level
  std::vector<float> values_;       ///< of the image, as those of the ring's level
  std::vector<float> weights_;      ///< 0 where the ring lies beside the image
  std::vector<float> residuals_, scratch_;
  std::vector<Share> shares_;
  CorrelationSum correlation_;
  float scale_ = 0.1F;  ///< of the residuals
};

}  // namespace window_ingress::detection
