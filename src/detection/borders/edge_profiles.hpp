#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "detection/borders/robust_line_fit.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// Where profiles are taken: across a straight stretch of the undistorted image.
struct ProfileGrid {
  Eigen::Vector2d from, to;  ///< ends of the stretch [px]
  int count = 80;            ///< profiles, evenly spaced
  double skip = 0.06;        ///< left out at both ends, in lengths of the stretch
  int reach_px = 6;          ///< samples on either side, a pixel of the image apart
  bool rough = false;        ///< the nearest pixel instead of interpolation
};

/// Width of a pixel of the image in the undistorted one, across a stretch at its middle: 1 without a lens.
double pixelAcross(const geometry::PinholeCamera* lens, const Eigen::Vector2d& from,
                   const Eigen::Vector2d& to);

/// Colours across a line: narrow profiles, sampled once and then read from many times. Keeps its memory.
///
/// Positions along the line are pixels of the undistorted image, in which it is straight. Offsets across it
/// are pixels of the image as it came, `pixel()` undistorted ones each: off a fisheye's axis the undistorted
/// image is stretched, its blur and its noise with it, and what holds of edges in an image holds in those of
/// it alone.
///
/// Offsets count along the normal, which points to the left of from -> to on the screen: outwards for the
/// sides of a quadrilateral in canonical order.
class EdgeProfiles {
 public:
  /// \param image CV_8UC1 or CV_8UC3
  /// \param lens null where the image is free of distortion; else points of the grid are distorted on their
  ///        way into the image, which stays as it is
  void sample(const cv::Mat& image, const geometry::PinholeCamera* lens, const ProfileGrid& grid);

  int count() const { return count_; }
  int reach() const { return reach_; }
  int width() const { return 2 * reach_ + 1; }
  int channels() const { return channels_; }
  double pixel() const { return pixel_; }                    ///< of an offset, in undistorted pixels
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
  template <int kChannels, bool kRough>
  void fill(const cv::Mat& image, const geometry::PinholeCamera* lens);

  int count_ = 0, reach_ = 0, channels_ = 1, inside_count_ = 0;
  double length_ = 0.0, pixel_ = 1.0;
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero(), normal_ = Eigen::Vector2d::UnitX();
  std::vector<float> values_;
  std::vector<double> position_;
  std::vector<unsigned char> inside_;
};

/// Many images have their colour at half of their size (JPEG and most video, cameras with a Bayer pattern):
/// there it is brightness that says where an edge is, to a pixel and better; colour lags behind by a pixel.

/// Brightness of a colour or a change of it, BGR (ITU-R BT.601).
float brightnessOf(const Eigen::Vector3f& bgr);

/// The profiles have colour, and it is softer than a pixel's blur: the squares of its second differences
/// against those of its first ones, which is 1 / (2 sigma^2) of an edge, and 3 of noise.
bool isColourSoft(const EdgeProfiles& profiles);

/// A change as far as soft colour can be trusted in it.
Eigen::Vector3f resolvedPart(const Eigen::Vector3f& change);

}  // namespace window_ingress::detection
