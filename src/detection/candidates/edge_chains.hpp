#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "detection/candidates/canny_edges.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// Sums over points, which give the least-squares line.
struct LineMoments {
  double n = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();

  void add(const Eigen::Vector2d& p) { add({1.0, p, p * p.transpose()}); }
  void add(const LineMoments& other) { n += other.n, sum += other.sum, squares += other.squares; }
  Eigen::Vector2d mean() const { return sum / n; }
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
  /// Runs from top to bottom of the image. Valid until the next call. Expensive when the lens changes.
  /// \param lens camera of the level, see `lensOfLevel`; null: no distortion
  const std::vector<EdgeChain>& run(const EdgeMap& map, const geometry::PinholeCamera* lens);

  /// Runs of the last map.
  const std::vector<EdgeChain>& runs() const { return runs_; }

  /// Pixels of all runs of the last map, in the raw level.
  const std::vector<cv::Point_<short>>& pixels() const { return pixels_; }

 private:
  struct Pixel {
    short x, y, dx, dy;
  };

  static Pixel pixelAt(const EdgeMap& map, int x, int y) {
    return {static_cast<short>(x), static_cast<short>(y), map.dx.ptr<short>(y)[x], map.dy.ptr<short>(y)[x]};
  }
  bool next(const EdgeMap& map, int sense, Pixel& at);
  void tabulate(const geometry::PinholeCamera& lens);
  void cut(bool is_distorted);
  void emit(std::size_t first, std::size_t last);

  std::optional<geometry::PinholeCamera> tabulated_;
  cv::Mat undistorted_;  ///< CV_32FC2, place of every pixel through that lens
  cv::Mat free_;         ///< CV_8UC1, edge pixels that belong to no chain yet
  std::vector<Pixel> chain_;
  std::vector<Eigen::Vector2d> points_;  ///< of the chain, undistorted
  std::vector<std::pair<std::size_t, std::size_t>> parts_;
  double straight_px_ = 1.0;
  std::vector<EdgeChain> runs_;
  std::vector<cv::Point_<short>> pixels_;
};

}  // namespace window_ingress::detection
