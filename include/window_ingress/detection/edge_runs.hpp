#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "window_ingress/detection/edge_map.hpp"
#include "window_ingress/detection/level_lens.hpp"

namespace window_ingress::detection {

struct EdgeRunsParams {
  double turn_rad = 0.7;     ///< a pixel follows another if their gradients differ less than this [rad]
  double straight_px = 0.9;  ///< a run leaves its chord by less than this, at a level side of 320 [px]
  double bow = 0.02;         ///< and by this part of the chord: lenses bend
  int min_pixels = 4;        ///< of a run; shorter ones are dropped

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("turn_rad", self.turn_rad, 0.05, 1.5);
    field("straight_px", self.straight_px, 0.3, 10.0);
    field("bow", self.bow, 0.0, 0.1);
    field("min_pixels", self.min_pixels, 2, 1000);
  }
};

/// Sums over points, from which the line of least squares follows.
struct LineMoments {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(const Eigen::Vector2d& p);
  void add(const LineMoments& other);
  Eigen::Vector2d mean() const { return {x / n, y / n}; }
  Eigen::Vector2d along() const;  ///< unit vector of least squares, of either sign
};

/// A straight run of connected edge pixels, in pixels of the undistorted search level.
struct EdgeRun {
  Eigen::Vector2d a, b;      ///< ends; seen from a to b the brighter side lies on the right of the screen
  Eigen::Vector2d normal;    ///< unit vector towards the brighter side
  LineMoments moments;       ///< of its pixels
  double contrast = 0.0;     ///< mean gradient [grey levels a pixel]
  int first = 0, count = 0;  ///< of its pixels, see EdgeRuns::pixels

  double length() const { return (b - a).norm(); }
};

/// Links neighbouring edge pixels of like gradient direction and cuts the chains where they bend: each pixel
/// is looked at once. The runs are what the Hough transform votes with.
class EdgeRuns {
 public:
  explicit EdgeRuns(const EdgeRunsParams& params);

  /// In the order of the image, from top to bottom. Valid until the next call.
  const std::vector<EdgeRun>& run(const EdgeMap& map, const LevelLens& lens);

  /// Those of the last map.
  const std::vector<EdgeRun>& runs() const { return runs_; }

  /// Pixels of all runs of the last map, in pixels of the level as it came.
  const std::vector<cv::Point_<short>>& pixels() const { return pixels_; }

 private:
  struct Pixel {
    short x, y, dx, dy;
  };

  bool next(const EdgeMap& map, int sense, Pixel& at);
  void follow(const EdgeMap& map, Pixel start, int sense, std::vector<Pixel>& pixels);
  void cut(const LevelLens& lens);
  void emit(std::size_t first, std::size_t last);

  EdgeRunsParams params_;
  float min_square_cosine_;
  cv::Mat free_;  ///< CV_8UC1, edge pixels that belong to no chain yet
  std::vector<Pixel> forward_, backward_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<std::pair<std::size_t, std::size_t>> parts_;
  double straight_px_ = 1.0;
  std::vector<EdgeRun> runs_;
  std::vector<cv::Point_<short>> pixels_;
};

}  // namespace window_ingress::detection
