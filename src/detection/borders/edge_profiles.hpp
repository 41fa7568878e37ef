#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "detection/borders/lines.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// Left out at both ends of a side, because corners are rounded [its lengths].
inline constexpr double kEndMargin = 0.06;

/// Where profiles are taken: across a straight stretch of the undistorted image.
struct ProfileGrid {
  Eigen::Vector2d from, to;        ///< ends of the stretch [px]
  int count = 0;                   ///< profiles, evenly spaced
  double end_margin = kEndMargin;  ///< left out at both ends, in lengths of the stretch
  int reach_px = 0;                ///< samples on either side, one raw pixel apart
  bool rough = false;              ///< nearest pixel instead of interpolation
};

/// Width of a raw pixel in undistorted pixels, across a stretch at its middle; 1 without a lens.
double pixelAcross(const geometry::PinholeCamera* lens, const Eigen::Vector2d& from,
                   const Eigen::Vector2d& to);

/// Colour profiles across a line: sampled once, then read many times. Keeps its memory.
///
/// Positions along the line are pixels of the undistorted image, where the line is straight. Offsets across
/// it are raw pixels, `pixel()` undistorted pixels each. Off a fisheye's axis the undistorted image is
/// stretched together with its blur and noise, so what is known about edges holds in raw pixels only.
///
/// Offsets count along the normal, which points to the left of from -> to on the screen: outwards for the
/// sides of a quadrilateral in canonical order.
class EdgeProfiles {
 public:
  /// \param image CV_8UC1 or CV_8UC3
  /// \param lens null: no distortion; otherwise the points of the grid are distorted, never the image
  void sample(const cv::Mat& image, const geometry::PinholeCamera* lens, const ProfileGrid& grid);

  int count() const { return count_; }
  int reach() const { return reach_; }
  int width() const { return 2 * reach_ + 1; }
  int channels() const { return channels_; }
  double pixel() const { return pixel_; }                    ///< width of an offset step [undistorted px]
  double length() const { return length_; }                  ///< of the stretch [px]
  const Eigen::Vector2d& middle() const { return middle_; }  ///< of the stretch
  const Eigen::Vector2d& normal() const { return normal_; }
  Eigen::Vector2d along() const { return {-normal_.y(), normal_.x()}; }

  /// The middle of the profile lies in the image; samples beyond its border repeat the last pixel.
  bool inside(int i) const { return inside_[i] != 0; }
  int insideCount() const { return inside_count_; }
  double position(int i) const { return position_[i]; }  ///< along the stretch, from its middle [px]
  /// Samples of a channel of a profile, from -reach to reach.
  const float* samples(int i, int channel) const {
    return values_.data() + (static_cast<std::size_t>(i) * channels_ + channel) * width();
  }
  /// The point of the undistorted image at a position along and an offset across.
  Eigen::Vector2d point(double position, double offset) const {
    return middle_ + position * along() + offset * pixel_ * normal_;
  }

  /// Mean of the profiles first <= i < last that lie in the image, channel by channel, `width()` each.
  /// \return how many there are
  int mean(int first, int last, float* out) const;
  /// Mean of all profiles along a line across them, from `half` inside to `half` outside of it, channel by
  /// channel, 2 half + 1 each. \return how many reach that far and lie in the image
  int meanAlong(const OffsetLine& line, int half, float* out) const;

 private:
  template <int kChannels>
  void fill(const cv::Mat& image, const geometry::PinholeCamera* lens, bool rough);

  int count_ = 0, reach_ = 0, channels_ = 1, inside_count_ = 0;
  double length_ = 0.0, pixel_ = 1.0;
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero(), normal_ = Eigen::Vector2d::UnitX();
  std::vector<float> values_;
  std::vector<double> position_;
  std::vector<unsigned char> inside_;
};

/// Many images store colour at half resolution (JPEG, most video, cameras with a Bayer pattern). Brightness
/// then locates an edge to a pixel or better, while colour may be off by a pixel.

/// True if the profiles have colour softer than a one-pixel blur, by the ratio of squared second to squared
/// first differences: 1 / (2 sigma^2) for an edge, 3 for noise.
bool isColourSoft(const EdgeProfiles& profiles);

/// A change of colour with its chromatic part reduced, because soft colour is less reliable.
Eigen::Vector3f resolvedPart(const Eigen::Vector3f& change);

}  // namespace window_ingress::detection
