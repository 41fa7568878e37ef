/// An approach for surveys of openness: true camera poses with simulated odometry, filter and detector.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "evaluation/openness/openness_survey.hpp"
#include "evaluation/poses/noisy_borders.hpp"
#include "simulation/random_stream.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/openness/openness_judge.hpp"

namespace window_ingress::evaluation {

class OpennessApproach {
 public:
  static constexpr geometry::OpeningSize kNeeded{0.6, 0.34};  ///< way of the vehicle that is judged [m]

  OpennessApproach(const OpennessRange& range, const geometry::OpeningSize& opening,
                   const openness::OpennessParams& params, std::uint32_t seed)
      : range_(range),
        opening_(opening),
        flight_(range.flight, seed),
        random_(seed, "openness approach"),
        judge_(params, kNeeded) {
    window_error_ = geometry::makePose(geometry::yawRotation(random_.normal(range.window_error_rad)),
                                       random_.normals(range.window_error_m));
    camera_turn_ = noisyTurn(range.attitude_bias_rad);
    for (double& bias : border_bias_px_) bias = random_.normal(range.border_bias_px);
  }

  int steps() const { return static_cast<int>(flight_.durationSec() * range_.rate_hz); }
  double timeSec(int step) const { return kFirstStamp_sec + step / range_.rate_hz; }
  simulation::CameraTruth motion(int step) const { return flight_.motion(step / range_.rate_hz); }

  /// The opening's border as a detector measures it, with noise. Nothing if it is not whole in the image.
  /// \param grown part of its size by which the measured border is larger than the true one
  std::optional<detection::WindowObservation> look(const geometry::PinholeCamera& camera, int step,
                                                   double grown = 0.0) {
    const Eigen::Isometry3d T_camera_window = motion(step).T_window_camera.inverse();
    const geometry::OpeningSize seen{opening_.width_m * (1.0 + grown), opening_.height_m * (1.0 + grown)};
    std::mt19937 random(static_cast<std::uint32_t>(random_.bits()));
    auto window =
        noisyBorders(camera.withoutDistortion(), T_camera_window, seen, range_.border_noise_px, random);
    if (!window) return std::nullopt;
    for (int i = 0; i < 4; ++i) {
      auto& [visible, sigma_px, sigma_rad, a, b] = window->edges[i];
      const Eigen::Vector2d along = (b - a).normalized(), outwards(along.y(), -along.x());
      a += border_bias_px_[i] * outwards;
      b += border_bias_px_[i] * outwards;
    }
    for (int i = 0; i < 4; ++i) {
      crossBorders(window->edges[(i + 3) % 4], window->edges[i], window->corners[i],
                   window->corner_covariance[i]);
      window->corners[i] = camera.distort(window->corners[i]);
      if (!camera.contains(window->corners[i], kSeen_px)) return std::nullopt;
    }
    window->stamp_sec = timeSec(step);
    window->target_id = 1;
    return window;
  }

  /// Passes a window to the judge, with noisy odometry and a slightly wrong filtered window.
  void judge(const detection::WindowObservation& window, const geometry::PinholeCamera& camera, int step) {
    drift_m_ += random_.normals(range_.drift_m_per_sqrt_sec / std::sqrt(range_.rate_hz));
    Eigen::Isometry3d T_odom_camera = motion(step).T_window_camera;
    T_odom_camera.translation() += drift_m_ + random_.normals(range_.position_noise_m);
    T_odom_camera = T_odom_camera * camera_turn_ * noisyTurn(range_.attitude_noise_rad);
    Eigen::Isometry3d T_odom_window = window_error_;
    T_odom_window.translation() += drift_m_;
    judge_.see({window, camera, T_odom_camera, T_odom_window, opening_});
  }

  /// Adds the verdict after this step to the result.
  void note(int step, OpennessResult& result, const OpennessStep& each) const {
    const double plane_m = -motion(step).T_window_camera.translation().x();
    const auto& verdict = judge_.verdict();
    if (plane_m >= range_.decide_m) result.at_decision = verdict;
    result.ever_closed |= verdict.openness == openness::Openness::kClosed;
    if (verdict.openness == openness::Openness::kOpen && !result.ever_open) {
      result.ever_open = true;
      result.open_from_m = plane_m;
    }
    if (each) each(plane_m, verdict);
  }

 private:
  static constexpr double kFirstStamp_sec = 100.0;
  static constexpr double kSeen_px = 3.0;  ///< least distance of each corner from the image's border

  Eigen::Isometry3d noisyTurn(double sigma_rad) {
    const Eigen::Vector3d turn = random_.normals(sigma_rad);
    const double angle = turn.norm();
    if (angle < 1e-12) return Eigen::Isometry3d::Identity();
    return Eigen::Isometry3d(Eigen::AngleAxisd(angle, turn / angle));
  }

  const OpennessRange& range_;
  geometry::OpeningSize opening_;
  SurveyFlight flight_;
  simulation::RandomStream random_;
  openness::OpennessJudge judge_;
  Eigen::Isometry3d window_error_, camera_turn_;
  Eigen::Vector3d drift_m_ = Eigen::Vector3d::Zero();
  std::array<double, 4> border_bias_px_;
};

}  // namespace window_ingress::evaluation
