#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/detection/window_tracker.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// An image that can be looked at: CV_8UC1 or CV_8UC3, not empty.
bool isUsableImage(const cv::Mat& image);

/// The same size, focal lengths, principal point and distortion.
bool isSameCalibration(const geometry::PinholeCamera& a, const geometry::PinholeCamera& b);

/// Images of one camera one after the other: what lies between the last two.
class ImageSequence {
 public:
  /// \param max_gap_sec images further apart do not continue each other
  explicit ImageSequence(double max_gap_sec) : max_gap_sec_(max_gap_sec) {}

  /// \return false if it does not continue the last one: no time went by or too much, or size or calibration
  /// are others. A new sequence begins then.
  bool take(const TrackInput& input);
  void forget();

  double elapsedSec() const { return elapsed_sec_; }  ///< since the image before; 0 at the first [s]
  cv::Size size() const { return size_; }
  int longerSide() const;
  /// The camera if it distorts, null if not.
  const geometry::PinholeCamera* lens() const;
  /// Homography of the undistorted image by the turn since the image before; nothing where an attitude of
  /// the two or the camera is not known.
  const std::optional<Eigen::Matrix3d>& turn() const { return turn_; }
  /// How far the jitter of the attitudes moves what `turn` says [px]: noise makes each turn the opposite of
  /// the one before, which no vehicle does.
  double turnSigmaPx() const;

 private:
  void noteJitter(const Eigen::Matrix3d& R_now_last);
  bool isContinuedBy(const TrackInput& input) const;

  double max_gap_sec_;
  cv::Size size_;
  std::optional<geometry::PinholeCamera> camera_;
  std::optional<double> last_sec_;
  std::optional<Eigen::Matrix3d> attitude_, turn_;
  double elapsed_sec_ = 0.0;
  std::optional<Eigen::Vector3d> last_turn_rad_;
  double jitter_rad2_ = 0.0;  ///< variance of an attitude about an axis, a running mean
};

}  // namespace window_ingress::detection
