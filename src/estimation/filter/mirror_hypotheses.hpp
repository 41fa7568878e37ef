#pragma once

#include <optional>
#include <vector>

#include "estimation/filter/window_hypothesis.hpp"
#include "window_ingress/estimation/window_filter.hpp"

namespace window_ingress::estimation {

/// The window and its mirror image: one or two hypotheses with weights that sum to 1, the heavier first.
class MirrorHypotheses {
 public:
  explicit MirrorHypotheses(const FilterParams& params) : params_(params) {}
  void assumeDrift(double m_per_sqrt_sec) { params_.drift_m_per_sqrt_sec = m_per_sqrt_sec; }

  struct Weighted {
    WindowHypothesis window;
    double log_weight;
  };

  /// Lets the camera's yaw be learned again.
  void learnYaw(double sigma_rad, const Eigen::Vector3d& camera_position) {
    for (Weighted& each : hypotheses_) each.window.addTurn(sigma_rad, camera_position, true);
  }
  bool empty() const { return hypotheses_.empty(); }
  void clear() { hypotheses_.clear(); }
  const std::vector<Weighted>& hypotheses() const { return hypotheses_; }

  /// Begins anew with a pose from one image, and with its mirror image.
  /// \return false, and nothing changed, if no upright window next to that pose, or to its mirror image,
  /// explains the image
  bool start(const Eigen::Isometry3d& T_odom_window, const SizeEstimate& size, const YawBias& yaw_bias,
             const FilterView& view);

  /// Predicts over the time and the distance flown, and applies an image to all hypotheses.
  /// \return the outcome for the hypothesis that fits best; nothing, and nothing changed, if the image is an
  /// outlier for all
  std::optional<WindowHypothesis::Outcome> apply(const FilterView& view, double elapsed_sec, double way_m);

  /// True if the mirror image is ruled out, or too near to matter.
  bool areUnambiguous() const;

  /// State of the window `age_sec` after the last image; without the fields about the images (`stamp_sec`,
  /// `updates`, `consistency`). Two hypotheses that need not be distinguished are merged with the spread of
  /// both. Not if empty. \param camera_position at the last image, in odom [m]
  /// \param unlearned_yaw_rad standard deviation of the camera's yaw in odom, beyond that of the hypotheses
  FilteredWindow windowAt(double age_sec, const Eigen::Vector3d& camera_position,
                          double unlearned_yaw_rad) const;

 private:
  void addMirrorImage(const FilterView& view, const SizeEstimate& size, const YawBias& yaw_bias,
                      double squares);
  void settle(const Eigen::Vector3d& camera_position);
  void normalise();
  void mergeOrDrop();
  void split(const Eigen::Vector3d& camera_position);

  FilterParams params_;
  std::vector<Weighted> hypotheses_;
  bool may_split_ = false;  ///< no evidence has ruled out the mirror image yet
};

}  // namespace window_ingress::estimation
