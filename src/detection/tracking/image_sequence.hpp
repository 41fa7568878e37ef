#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/detection/window_tracker.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// A usable image: CV_8UC1 or CV_8UC3, not empty.
inline bool isUsableImage(const cv::Mat& image) {
  return !image.empty() && (image.type() == CV_8UC1 || image.type() == CV_8UC3);
}

/// A sequence of images from one camera: time and rotation between the last two.
class ImageSequence {
 public:
  /// \param max_gap_sec images further apart start a new sequence
  explicit ImageSequence(double max_gap_sec) : max_gap_sec_(max_gap_sec) {}

  /// \return false if the image starts a new sequence: no time or too much has passed, or size or calibration
  /// differ
  bool take(const TrackInput& input) {
    const bool continued = isContinuedBy(input);
    if (!continued) forget();
    elapsed_sec_ = continued ? input.stamp_sec - *last_sec_ : 0.0;
    size_ = input.image.size();
    camera_.reset();
    if (input.camera) camera_ = *input.camera;
    const bool has_attitude = input.R_world_camera && geometry::isRotation(*input.R_world_camera);
    turn_.reset();
    if (has_attitude && attitude_ && camera_) {
      const Eigen::Matrix3d K = camera_->K(), R_now_last = input.R_world_camera->transpose() * *attitude_;
      turn_ = K * R_now_last * K.inverse();
      noteJitter(R_now_last);
    } else {
      last_turn_rad_.reset();
    }
    attitude_.reset();
    if (has_attitude) attitude_ = input.R_world_camera;
    last_sec_ = input.stamp_sec;
    return continued;
  }

  void forget() {
    last_sec_.reset();
    attitude_.reset();
    last_turn_rad_.reset();
  }

  double elapsedSec() const { return elapsed_sec_; }  ///< since the previous image; 0 at the first [s]
  cv::Size size() const { return size_; }
  int longerSide() const { return std::max(size_.width, size_.height); }
  /// The camera if it distorts, else null.
  const geometry::PinholeCamera* lens() const {
    return camera_ && camera_->hasDistortion() ? &*camera_ : nullptr;
  }

  /// Homography of the undistorted image for the rotation since the previous image; nothing if the camera or
  /// one of the two attitudes is unknown.
  const std::optional<Eigen::Matrix3d>& turn() const { return turn_; }
  /// Error of `turn` due to jitter of the attitudes [px]. Jitter shows as successive rotations in opposite
  /// directions, which no vehicle performs.
  double turnSigmaPx() const { return camera_ ? camera_->fx * std::sqrt(2.0 * jitter_rad2_) : 0.0; }

 private:
  // The difference of two successive rotations has six times the variance of white attitude noise.
  void noteJitter(const Eigen::Matrix3d& R_now_last) {
    constexpr double kRate = 0.1, kSquares = 6.0, kAxes = 3.0;
    const Eigen::AngleAxisd turned(R_now_last);
    const Eigen::Vector3d turn_rad = turned.angle() * turned.axis();
    if (last_turn_rad_)
      jitter_rad2_ +=
          kRate * ((turn_rad - *last_turn_rad_).squaredNorm() / (kSquares * kAxes) - jitter_rad2_);
    last_turn_rad_ = turn_rad;
  }

  bool isContinuedBy(const TrackInput& input) const {
    if (!last_sec_ || input.image.size() != size_ || (input.camera != nullptr) != camera_.has_value())
      return false;
    if (input.camera && !(*input.camera == *camera_)) return false;
    const double elapsed = input.stamp_sec - *last_sec_;
    return elapsed > 0.0 && elapsed <= max_gap_sec_;
  }

  double max_gap_sec_;
  cv::Size size_;
  std::optional<geometry::PinholeCamera> camera_;
  std::optional<double> last_sec_;
  std::optional<Eigen::Matrix3d> attitude_, turn_;
  double elapsed_sec_ = 0.0;
  std::optional<Eigen::Vector3d> last_turn_rad_;
  double jitter_rad2_ = 0.0;  ///< running mean of an attitude's variance about one axis
};

}  // namespace window_ingress::detection
