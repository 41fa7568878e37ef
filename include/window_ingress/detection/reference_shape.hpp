#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "window_ingress/detection/side_profile.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

struct ReferenceShapeParams {
  bool compare = true;         ///< else every shape will do
  double sigmas = 3.0;         ///< standard deviations that a shape may differ from the reference's
  double corner_px = 0.3;      ///< least standard deviation of a corner, each way [px]
  double aspect_sigma = 0.03;  ///< of the logarithm of the aspect: how well the reference shows it, at best
  double frame_px = 0.03;      ///< standard deviation of the width of a frame [px]
  double frame_slack = 0.15;   ///< that width may differ by this part beyond that

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("compare", self.compare);
    field("sigmas", self.sigmas, 0.0, 100.0);
    field("corner_px", self.corner_px, 0.0, 10.0);
    field("aspect_sigma", self.aspect_sigma, 0.001, 10.0);
    field("frame_px", self.frame_px, 0.0, 10.0);
    field("frame_slack", self.frame_slack, 0.0, 10.0);
  }
};

/// A value as far as a picture tells.
struct Measured {
  double value = 0.0, sigma = 0.0;
};

/// The target's shape as the reference picture shows it: aspect of the opening, and the width of its frame
/// relative to the opening's sides. Both stay the same from anywhere; size does not show in one picture.
class ReferenceShape {
 public:
  explicit ReferenceShape(const ReferenceShapeParams& params) : params_(params) {}

  /// \param picture by an unknown camera: its focal length is taken to be half to twice the longer side
  void learn(const cv::Mat& picture, const geometry::Quadrilateral& opening);
  void forget() { aspect_.reset(), frame_.fill(0.0); }

  /// Where a shape differs by more than it may: value and limit; nothing where it does not, or cannot be
  /// told.
  struct Difference {
    double value, limit;
  };

  /// \param corners fitted, pixels of the image as it came; \param camera without one nothing is told
  std::optional<Difference> inAspect(const geometry::Quadrilateral& corners,
                                     const std::array<Eigen::Matrix2d, 4>& covariance,
                                     const geometry::PinholeCamera* camera) const;

  /// Middle of the four sides' widths, each over the reference's: one side may be hidden, or have a sill.
  std::optional<Difference> inFrame(const cv::Mat& image, const geometry::Quadrilateral& corners,
                                    const geometry::PinholeCamera* camera);

  /// The ratio itself.
  std::optional<Measured> frameRatio(const cv::Mat& image, const geometry::Quadrilateral& corners,
                                     const geometry::PinholeCamera* camera);

 private:
  ReferenceShapeParams params_;
  std::optional<Measured> aspect_;  ///< sigma: half the range over all focal lengths
  double seen_aspect_ = 1.0;
  std::array<double, 4> frame_{};  ///< of each side [mean sides of the opening]; 0: no frame
  std::array<SideProfile, 4> sides_;
  std::vector<double> ratios_;
};

}  // namespace window_ingress::detection
