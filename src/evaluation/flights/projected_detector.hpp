/// A detector in place of the detector: for campaigns of thousands of flights in minutes.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "simulation/random_stream.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::evaluation {

/// How the window is seen where no image is drawn.
struct SightParams {
  double sample_sigma_px = 0.5;    ///< noise of a border across itself, in each of its pixels [px]
  double lasting_sigma_px = 0.1;   ///< of each border, the same in all images from one place [px]
  double lasting_m = 0.5;          ///< one place is this large [m]
  double miss_rate = 0.0;          ///< share of images in which nothing is found
  double least_side_px = 24.0;     ///< smaller openings are not found [px]
  double least_part_px = 40.0;     ///< a side with less than this in the image is not seen [px]
  double picture_margin_px = 4.0;  ///< nor is what lies this near the image's border [px]
};

/// What a detector that never errs would say: the true borders of the opening's front, cut by the image's
/// border, each with the noise of a line fit. It knows no wall, no light, no decoy and no other window. Not a
/// measure of the whole: only of what comes behind the detector.
class ProjectedDetector {
 public:
  explicit ProjectedDetector(std::uint32_t seed, const SightParams& params = {});

  /// \param T_camera_window of the exposure \return nothing from behind or beside, out of the image, or
  /// missed
  std::optional<detection::WindowObservation> look(const geometry::PinholeCamera& camera,
                                                   const Eigen::Isometry3d& T_camera_window,
                                                   const geometry::OpeningSize& opening, double stamp_sec);

 private:
  void renewLasting(const Eigen::Vector3d& position_m);

  SightParams params_;
  simulation::RandomStream random_;
  std::optional<Eigen::Vector3d> lasting_from_m_;
  Eigen::Vector4d lasting_px_ = Eigen::Vector4d::Zero();
  bool seen_whole_ = false;  ///< since it was last out of the image: only then parts of it are known as such
};

}  // namespace window_ingress::evaluation
