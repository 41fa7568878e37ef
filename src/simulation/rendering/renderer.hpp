#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>

#include "simulation/scene/scene.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

class GlContext;

/// How the edges of surfaces are smoothed.
enum class Antialiasing {
  kEdges,         ///< one sample a pixel, then by the exact area on either side of each visible edge
  kMultisampling  ///< four samples a pixel; four times slower: the reference
};

/// Images of a scene by an ideal camera, drawn in software.
///
/// The projection is built from K itself: the point that `PinholeCamera::project` sends to (u, v) lies at (u,
/// v) of the image, pixel centres at integers. Distortion is not drawn here; see `Lens`. One renderer per
/// thread at a time; several may exist. Drawing runs in the calling thread; a process that flies one
/// world in real time may set LP_NUM_THREADS in its environment before the first one is made.
class Renderer {
 public:
  /// \throws std::runtime_error if there is no software renderer, std::invalid_argument for a camera that
  /// cannot be used or has distortion
  Renderer(const Scene& scene, const geometry::PinholeCamera& camera,
           Antialiasing antialiasing = Antialiasing::kEdges);
  /// By `context` instead of the one the package was configured with.
  Renderer(const Scene& scene, const geometry::PinholeCamera& camera, Antialiasing antialiasing,
           std::unique_ptr<GlContext> context);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// CV_8UC3, BGR, of the camera's size; `image` is reused if it fits.
  void render(const Eigen::Isometry3d& T_camera_window, cv::Mat& image);
  /// As `render`, but only the rows `rows` of `image` are drawn; the others stay as they are.
  void renderRows(const Eigen::Isometry3d& T_camera_window, const cv::Range& rows, cv::Mat& image);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::simulation
