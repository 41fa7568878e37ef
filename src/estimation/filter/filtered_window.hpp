#pragma once

#include "estimation/filter/mirror_hypotheses.hpp"
#include "window_ingress/estimation/window_filter.hpp"

namespace window_ingress::estimation {

/// What the hypotheses say of the window so long after the last image, without what the images themselves
/// were (`stamp_sec`, `updates`, `consistency`). Two that need not be told apart are one with the spread of
/// both. \param beliefs at least one \param camera_position of the last image, in odom [m]
/// \param unlearned_yaw_rad of the camera in odom, beside what the hypotheses know: a standard deviation
FilteredWindow filteredWindow(const MirrorHypotheses& beliefs, const FilterParams& params,
                              const Eigen::Vector3d& camera_position, double unlearned_yaw_rad,
                              double age_sec);

}  // namespace window_ingress::estimation
