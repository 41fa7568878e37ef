/// A substitute for the detector, for campaigns of thousands of flights in minutes.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "simulation/random_stream.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::evaluation {

/// How the window is detected without an image.
struct SightParams {
  double sample_sigma_px = 0.5;    ///< noise across a border, of each of its pixels [px]
  double lasting_sigma_px = 0.1;   ///< error of each border, constant in all images from one place [px]
  double lasting_m = 0.5;          ///< size of one place [m]
  double miss_rate = 0.0;          ///< share of images in which nothing is found
  double least_side_px = 24.0;     ///< smaller openings are not found [px]
  double least_part_px = 40.0;     ///< a side with less than this in the image is not seen [px]
  double picture_margin_px = 4.0;  ///< nothing this close to the image's border is seen [px]
};

/// An ideal detector: gives the true borders of the opening's front, clipped at the image's border, each with
/// the noise of a line fit. It ignores walls, light, decoys and other windows. So it tests only the stages
/// after the detector.
class ProjectedDetector {
 public:
  explicit ProjectedDetector(std::uint32_t seed, const SightParams& params = {});

  /// \param T_camera_window pose at the exposure
  /// \return nothing if seen from behind or beside, out of the image, or missed
  std::optional<detection::WindowObservation> look(const geometry::PinholeCamera& camera,
                                                   const Eigen::Isometry3d& T_camera_window,
                                                   const geometry::OpeningSize& opening, double stamp_sec);

 private:
  void renewLasting(const Eigen::Vector3d& position_m);

  SightParams params_;
  simulation::RandomStream random_;
  std::optional<Eigen::Vector3d> lasting_from_m_;
  Eigen::Vector4d lasting_px_ = Eigen::Vector4d::Zero();
  bool seen_whole_ = false;  ///< since it was last out of the image; only then its parts are recognised
};

}  // namespace window_ingress::evaluation
