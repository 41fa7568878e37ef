/// A substitute for the detector, for campaigns of thousands of flights in minutes.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>

#include "evaluation/poses/noisy_borders.hpp"
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
  explicit ProjectedDetector(std::uint32_t seed, const SightParams& params = {})
      : params_(params), random_(seed, "projected sight") {}

  /// \param T_camera_window pose at the exposure
  /// \return nothing if seen from behind or beside, out of the image, or missed
  std::optional<detection::WindowObservation> look(const geometry::PinholeCamera& camera,
                                                   const Eigen::Isometry3d& T_camera_window,
                                                   const geometry::OpeningSize& opening, double stamp_sec) {
    const Eigen::Vector3d position_m = T_camera_window.inverse().translation();
    renewLasting(position_m);
    const bool missed = random_.uniform(0.0, 1.0) < params_.miss_rate;
    if (missed || position_m.x() >= 0.0) return std::nullopt;

    const auto corners = geometry::openingCorners(opening);
    std::array<Stretch, 4> stretches;
    detection::WindowObservation window;
    window.stamp_sec = stamp_sec;
    window.target_id = 1;
    window.score = 1.0;
    for (int i = 0; i < 4; ++i) {
      stretches[i] = visibleStretch(camera, T_camera_window * corners[i],
                                    T_camera_window * corners[(i + 1) % 4], params_.picture_margin_px);
      const bool is_whole = stretches[i].hasStart() && stretches[i].hasEnd();
      const double least_px = is_whole ? params_.least_side_px : params_.least_part_px;
      if (stretches[i].lengthPx() < least_px) continue;
      const Eigen::Vector2d &a = stretches[i].a, &b = stretches[i].b;
      const double offset = random_.normal(), turn = random_.normal();
      window.edges[i] = noisyBorder(a, b, params_.sample_sigma_px, offset, turn);
      const Eigen::Vector2d along = (b - a).normalized(), across(-along.y(), along.x());
      window.edges[i].a += lasting_px_(i) * across;
      window.edges[i].b += lasting_px_(i) * across;
    }
    for (int i = 0; i < 4; ++i) {
      const int before = (i + 3) % 4;
      window.corner_visible[i] = window.edges[before].visible && window.edges[i].visible &&
                                 stretches[before].hasEnd() && stretches[i].hasStart();
      if (window.corner_visible[i])
        crossBorders(window.edges[before], window.edges[i], window.corners[i], window.corner_covariance[i]);
    }
    seen_whole_ = (seen_whole_ || window.whole()) && window.visibleSides() > 0;
    return seen_whole_ && window.visibleSides() >= 2 ? std::optional(window) : std::nullopt;
  }

 private:
  static constexpr int kPoints = 64;  // along a side, each checked for being in the image

  /// The part of a side that lies in the image.
  struct Stretch {
    Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero();
    int first = -1, last = -1;  ///< indices of its points; -1: none
    bool hasStart() const { return first == 0; }
    bool hasEnd() const { return last == kPoints; }
    double lengthPx() const { return first < 0 ? 0.0 : (b - a).norm(); }
  };

  static std::optional<Eigen::Vector2d> pixelOf(const geometry::PinholeCamera& camera,
                                                const Eigen::Vector3d& p_camera, double margin_px) {
    const auto pixel = camera.project(p_camera);
    if (!pixel || !camera.contains(*pixel, margin_px)) return std::nullopt;
    // Far outside its image a lens may fold rays back into it.
    return camera.ray(*pixel).dot(p_camera.normalized()) > 0.9999 ? pixel : std::nullopt;
  }

  static Stretch visibleStretch(const geometry::PinholeCamera& camera, const Eigen::Vector3d& from,
                                const Eigen::Vector3d& to, double margin_px) {
    Stretch stretch;
    for (int i = 0; i <= kPoints; ++i) {
      const auto pixel = pixelOf(camera, from + (to - from) * i / kPoints, margin_px);
      if (!pixel && stretch.first >= 0) break;
      if (!pixel) continue;
      if (stretch.first < 0) stretch.first = i, stretch.a = *pixel;
      stretch.last = i, stretch.b = *pixel;
    }
    return stretch;
  }

  void renewLasting(const Eigen::Vector3d& position_m) {
    if (lasting_from_m_ && (position_m - *lasting_from_m_).norm() < params_.lasting_m) return;
    lasting_from_m_ = position_m;
    for (int i = 0; i < 4; ++i) lasting_px_(i) = random_.normal(params_.lasting_sigma_px);
  }

  SightParams params_;
  simulation::RandomStream random_;
  std::optional<Eigen::Vector3d> lasting_from_m_;
  Eigen::Vector4d lasting_px_ = Eigen::Vector4d::Zero();
  bool seen_whole_ = false;  ///< since it was last out of the image; only then its parts are recognised
};

}  // namespace window_ingress::evaluation
