#include "window_ingress/detection/picture_sequence.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "window_ingress/detection/track_picture.hpp"

namespace window_ingress::detection {

bool PictureSequence::isContinuedBy(const TrackInput& input) const {
  if (!last_sec_ || input.image.size() != size_ || (input.camera != nullptr) != camera_.has_value())
    return false;
  if (input.camera && !isSameCalibration(*input.camera, *camera_)) return false;
  const double elapsed = input.stamp_sec - *last_sec_;
  return elapsed > 0.0 && elapsed <= max_gap_sec_;
}

bool PictureSequence::take(const TrackInput& input) {
  const bool continued = isContinuedBy(input);
  if (!continued) forget();
  elapsed_sec_ = continued ? input.stamp_sec - *last_sec_ : 0.0;
  size_ = input.image.size();
  camera_.reset();
  if (input.camera) camera_ = *input.camera;
  const bool has_attitude = input.R_world_camera && input.R_world_camera->allFinite();
  turn_.reset();
  if (has_attitude && attitude_ && camera_) {
    const Eigen::Matrix3d K = camera_->K(), R_now_last = input.R_world_camera->transpose() * *attitude_;
    turn_ = K * R_now_last * K.inverse();
  }
  attitude_.reset();
  if (has_attitude) attitude_ = input.R_world_camera;
  last_sec_ = input.stamp_sec;
  return continued;
}

void PictureSequence::forget() {
  last_sec_.reset();
  attitude_.reset();
}

int PictureSequence::longerSide() const { return std::max(size_.width, size_.height); }

const geometry::PinholeCamera* PictureSequence::lens() const {
  return camera_ && camera_->hasDistortion() ? &*camera_ : nullptr;
}

}  // namespace window_ingress::detection
