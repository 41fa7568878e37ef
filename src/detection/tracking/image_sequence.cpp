#include "detection/tracking/image_sequence.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::detection {

bool isUsableImage(const cv::Mat& image) {
  return !image.empty() && (image.type() == CV_8UC1 || image.type() == CV_8UC3);
}

bool isSameCalibration(const geometry::PinholeCamera& a, const geometry::PinholeCamera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx &&
         a.cy == b.cy && a.distortion == b.distortion && a.model == b.model;
}

bool ImageSequence::isContinuedBy(const TrackInput& input) const {
  if (!last_sec_ || input.image.size() != size_ || (input.camera != nullptr) != camera_.has_value())
    return false;
  if (input.camera && !isSameCalibration(*input.camera, *camera_)) return false;
  const double elapsed = input.stamp_sec - *last_sec_;
  return elapsed > 0.0 && elapsed <= max_gap_sec_;
}

bool ImageSequence::take(const TrackInput& input) {
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

// White noise of attitudes has six times its variance in the difference of two turns in a row.
void ImageSequence::noteJitter(const Eigen::Matrix3d& R_now_last) {
  constexpr double kRate = 0.1, kSquares = 6.0, kAxes = 3.0;
  const Eigen::AngleAxisd turned(R_now_last);
  const Eigen::Vector3d turn_rad = turned.angle() * turned.axis();
  if (last_turn_rad_)
    jitter_rad2_ += kRate * ((turn_rad - *last_turn_rad_).squaredNorm() / (kSquares * kAxes) - jitter_rad2_);
  last_turn_rad_ = turn_rad;
}

double ImageSequence::turnSigmaPx() const {
  return camera_ ? camera_->fx * std::sqrt(2.0 * jitter_rad2_) : 0.0;
}

void ImageSequence::forget() {
  last_sec_.reset();
  attitude_.reset();
  last_turn_rad_.reset();
}

int ImageSequence::longerSide() const { return std::max(size_.width, size_.height); }

const geometry::PinholeCamera* ImageSequence::lens() const {
  return camera_ && camera_->hasDistortion() ? &*camera_ : nullptr;
}

}  // namespace window_ingress::detection
