#pragma once

#include "estimation/filter/mirror_hypotheses.hpp"
#include "window_ingress/estimation/window_filter.hpp"

namespace window_ingress::estimation {

/// State of the window `age_sec` after the last image, from the hypotheses; without the fields about the
/// images (`stamp_sec`, `updates`, `consistency`). Two hypotheses that need not be distinguished are merged
/// with the spread of both. \param beliefs at least one \param camera_position at the last image, in odom [m]
/// \param unlearned_yaw_rad standard deviation of the camera's yaw in odom, beyond that of the hypotheses
FilteredWindow filteredWindow(const MirrorHypotheses& beliefs, const FilterParams& params,
                              const Eigen::Vector3d& camera_position, double unlearned_yaw_rad,
                              double age_sec);

}  // namespace window_ingress::estimation
