#pragma once

#include <array>

#include "detection/tracking/edge_tracker.hpp"
#include "detection/tracking/quad_motion.hpp"
#include "window_ingress/detection/window_observation.hpp"

namespace window_ingress::detection {

/// Tracks the four borders of a window together.
class QuadTracker {
 public:
  /// Starts to track the borders of a window just found. \param is_known the borders follow from the
  /// surroundings, which are compared again soon: the nearest edges are tracked instead
  void learn(const LensImage& view, const geometry::Quadrilateral& quad, bool is_known);

  /// Searches all borders near the prediction and corrects it by those found.
  /// \return true if enough of the borders in view are found, and the shape changed as a window's can
  bool follow(const LensImage& view, QuadMotion& motion);

  /// Borders and corners as tracked last, in canonical order, raw pixels.
  void describe(const LensImage& view, const QuadMotion& motion, WindowObservation& window) const;
  /// Updates the memory of the borders tracked last.
  void keep(const geometry::Quadrilateral& quad);
  /// Declares that the borders lie there. Edges tracked beside them are reported as these borders from now
  /// on. If the tracked edge is too far away or was not found, a new edge is learned at the border.
  /// \return true if an edge was learned; then the motion is moved
  bool realign(const LensImage& view, const RefinedBorders& borders, QuadMotion& motion);

  int inView() const { return in_view_; }
  int fitted() const { return fitted_; }
  double quality() const;  ///< mean agreement of the searched borders, 0 to 1

 private:
  bool keepsShape(const QuadMotion& motion) const;
  void placeCorners(QuadMotion& motion) const;

  std::array<EdgeTracker, 4> edges_;
  std::array<FollowedBorder, 4> borders_;
  int in_view_ = 0, sought_ = 0, fitted_ = 0;
};

}  // namespace window_ingress::detection
