#include "evaluation/flights/projected_detector.hpp"

#include <array>

#include "evaluation/poses/noisy_borders.hpp"

namespace window_ingress::evaluation {
namespace {

constexpr int kPoints = 64;  // along a side, each checked for being in the image

/// The part of a side that lies in the image.
struct Stretch {
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero();
  int first = -1, last = -1;  ///< indices of its points; -1: none
  bool hasStart() const { return first == 0; }
  bool hasEnd() const { return last == kPoints; }
  double lengthPx() const { return first < 0 ? 0.0 : (b - a).norm(); }
};

std::optional<Eigen::Vector2d> pixelOf(const geometry::PinholeCamera& camera, const Eigen::Vector3d& p_camera,
                                       double margin_px) {
  const auto pixel = camera.project(p_camera);
  if (!pixel || !camera.contains(*pixel, margin_px)) return std::nullopt;
  // Far outside its image a lens may fold rays back into it.
  const Eigen::Vector3d ray = camera.ray(*pixel);
  return ray.dot(p_camera.normalized()) > 0.9999 ? pixel : std::nullopt;
}

Stretch visibleStretch(const geometry::PinholeCamera& camera, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& to, double margin_px) {
  Stretch stretch;
  for (int i = 0; i <= kPoints; ++i) {
    const auto pixel = pixelOf(camera, from + (to - from) * i / kPoints, margin_px);
    if (!pixel && stretch.first >= 0) break;
    if (!pixel) continue;
    if (stretch.first < 0) {
      stretch.first = i;
      stretch.a = *pixel;
    }
    stretch.last = i;
    stretch.b = *pixel;
  }
  return stretch;
}

detection::Edge fitted(const Stretch& stretch, double sample_sigma_px, double lasting_px,
                       simulation::RandomStream& random) {
  const double offset = random.normal(), turn = random.normal();
  detection::Edge edge = noisyBorder(stretch.a, stretch.b, sample_sigma_px, offset, turn);
  const Eigen::Vector2d along = (stretch.b - stretch.a).normalized(), across(-along.y(), along.x());
  edge.a += lasting_px * across;
  edge.b += lasting_px * across;
  return edge;
}

}  // namespace

ProjectedDetector::ProjectedDetector(std::uint32_t seed, const SightParams& params)
    : params_(params), random_(seed, "projected sight") {}

void ProjectedDetector::renewLasting(const Eigen::Vector3d& position_m) {
  if (lasting_from_m_ && (position_m - *lasting_from_m_).norm() < params_.lasting_m) return;
  lasting_from_m_ = position_m;
  for (int i = 0; i < 4; ++i) lasting_px_(i) = random_.normal(params_.lasting_sigma_px);
}

std::optional<detection::WindowObservation> ProjectedDetector::look(const geometry::PinholeCamera& camera,
                                                                    const Eigen::Isometry3d& T_camera_window,
                                                                    const geometry::OpeningSize& opening,
                                                                    double stamp_sec) {
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
    window.edges[i] = fitted(stretches[i], params_.sample_sigma_px, lasting_px_(i), random_);
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

}  // namespace window_ingress::evaluation
