/// An approach for surveys of openness: true camera poses with simulated odometry, filter and detector.
#pragma once

#include <optional>

#include "evaluation/openness/openness_survey.hpp"
#include "simulation/random_stream.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/openness/openness_judge.hpp"

namespace window_ingress::evaluation {

class OpennessApproach {
 public:
  OpennessApproach(const OpennessRange& range, const geometry::OpeningSize& opening,
                   const openness::OpennessParams& params, std::uint32_t seed);

  int steps() const;
  double timeSec(int step) const { return kFirstStamp_sec + step / range_.rate_hz; }
  simulation::CameraTruth motion(int step) const { return flight_.motion(step / range_.rate_hz); }

  /// The opening's border as a detector measures it, with noise. Nothing if it is not whole in the image.
  /// \param grown part of its size by which the measured border is larger than the true one
  std::optional<detection::WindowObservation> look(const geometry::PinholeCamera& camera, int step,
                                                   double grown = 0.0);
  /// Passes a window to the judge, with noisy odometry and a slightly wrong filtered window.
  void judge(const detection::WindowObservation& window, const geometry::PinholeCamera& camera, int step);
  void note(int step, OpennessResult& result, const OpennessStep& each) const;

 private:
  Eigen::Isometry3d noisyTurn(double sigma_rad);
  static constexpr double kFirstStamp_sec = 100.0;

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
