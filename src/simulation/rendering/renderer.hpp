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
  kEdges,         ///< one sample per pixel, then exact areas on both sides of each visible edge
  kMultisampling  ///< four samples per pixel, as a reference; four times slower
};

/// Renders a scene with an ideal camera in software.
///
/// The projection is built from K itself: the point that `PinholeCamera::project` maps to (u, v) lies at (u,
/// v) of the image, with pixel centres at integers. Distortion is applied elsewhere, see `Lens`. Use one
/// renderer per thread at a time; several may exist. Drawing runs in the calling thread. A process that flies
/// one world in real time may set LP_NUM_THREADS in its environment before it makes the first renderer.
class Renderer {
 public:
  /// \throws std::runtime_error if there is no software renderer, std::invalid_argument for a camera that
  /// cannot be used or has distortion
  /// \param context instead of one of the configured library
  Renderer(const Scene& scene, const geometry::PinholeCamera& camera,
           Antialiasing antialiasing = Antialiasing::kEdges, std::shared_ptr<GlContext> context = nullptr);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// \param image CV_8UC3, BGR, of the camera's size; reused if it fits
  void render(const Eigen::Isometry3d& T_camera_window, cv::Mat& image);
  /// As `render`, but draws only the rows `rows` of `image`; the others stay unchanged.
  void renderRows(const Eigen::Isometry3d& T_camera_window, const cv::Range& rows, cv::Mat& image);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::simulation
