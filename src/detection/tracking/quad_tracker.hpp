#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "detection/tracking/edge_tracker.hpp"
#include "detection/tracking/quad_motion.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/window_observation.hpp"

namespace window_ingress::detection {

/// The four borders of the tracked window, followed together.
class QuadTracker {
 public:
  /// Takes the borders of a window that was just found as what is to be followed. \param is_known by what
  /// lies round it, which is asked again soon: the edges nearest to them are followed for them
  void learn(const cv::Mat& image, const geometry::PinholeCamera* lens, const geometry::Quadrilateral& quad,
             bool is_known);

  /// Looks for all of them round the prediction; corrects it by what was found.
  /// \return true if enough of the borders in view are found, and the shape changed as a window's can
  bool follow(const cv::Mat& image, const geometry::PinholeCamera* lens, QuadMotion& motion);

  /// Borders and corners as followed last, in canonical order, pixels of the image as it came.
  void describe(const cv::Mat& image, const geometry::PinholeCamera* lens, const QuadMotion& motion,
                WindowObservation& window) const;
  /// Takes them into memory.
  void keep(const geometry::Quadrilateral& quad);
  /// The borders lie there: edges that were followed beside them are reported as them from now on. A border
  /// whose edge is too far from it, or was not found, is taken as what is to be followed.
  /// \return true if there was such a border; the motion is moved then
  bool realign(const cv::Mat& image, const geometry::PinholeCamera* lens, const RefinedBorders& borders,
               QuadMotion& motion);

  int inView() const { return in_view_; }
  int fitted() const { return fitted_; }
  double quality() const;  ///< mean agreement of the borders sought, 0 to 1

 private:
  bool keepsShape(const QuadMotion& motion) const;
  void placeCorners(QuadMotion& motion) const;

  std::array<EdgeTracker, 4> edges_;
  std::array<FollowedBorder, 4> borders_;
  int in_view_ = 0, sought_ = 0, fitted_ = 0;
};

}  // namespace window_ingress::detection
