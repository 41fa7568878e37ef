#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "detection/candidates/canny_edges.hpp"
#include "detection/candidates/undistortion_map.hpp"
#include "window_ingress/detection/detector_params.hpp"

namespace window_ingress::detection {

/// Sums over points, which give the least-squares line.
struct LineMoments {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(const Eigen::Vector2d& p);
  void add(const LineMoments& other);
  Eigen::Vector2d mean() const { return {x / n, y / n}; }
  Eigen::Vector2d along() const;  ///< unit vector of the least-squares line, either sign
};

/// A straight run of connected edge pixels, in pixels of the undistorted search level.
struct EdgeChain {
  Eigen::Vector2d a, b;      ///< ends; seen from a to b the brighter side lies on the right of the screen
  Eigen::Vector2d normal;    ///< unit vector towards the brighter side
  LineMoments moments;       ///< of its pixels
  double contrast = 0.0;     ///< mean gradient [grey levels per pixel]
  int first = 0, count = 0;  ///< range of its pixels, see EdgeChains::pixels
};

/// Links neighbouring edge pixels of similar gradient direction and cuts the chains where they bend. Visits
/// each pixel once. The runs cast the votes of the Hough transform.
class EdgeChains {
 public:
  /// Runs from top to bottom of the image. Valid until the next call.
  const std::vector<EdgeChain>& run(const EdgeMap& map, const UndistortionMap& lens);

  /// Runs of the last map.
  const std::vector<EdgeChain>& runs() const { return runs_; }

  /// Pixels of all runs of the last map, in the raw level.
  const std::vector<cv::Point_<short>>& pixels() const { return pixels_; }

 private:
  struct Pixel {
    short x, y, dx, dy;
  };

  bool next(const EdgeMap& map, int sense, Pixel& at);
  void follow(const EdgeMap& map, Pixel start, int sense, std::vector<Pixel>& pixels);
  void cut(const UndistortionMap& lens);
  void emit(std::size_t first, std::size_t last);

  cv::Mat free_;  ///< CV_8UC1, edge pixels that belong to no chain yet
  std::vector<Pixel> forward_, backward_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<std::pair<std::size_t, std::size_t>> parts_;
  double straight_px_ = 1.0;
  std::vector<EdgeChain> runs_;
  std::vector<cv::Point_<short>> pixels_;
};

}  // namespace window_ingress::detection
