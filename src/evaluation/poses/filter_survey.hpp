#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "evaluation/poses/synthetic_approach.hpp"
#include "evaluation/statistics.hpp"
#include "window_ingress/estimation/target_estimator.hpp"

namespace window_ingress::evaluation {

/// State of the filter after one image of a synthetic approach, with the truth.
struct FilterSample {
  double time_sec = 0.0, flown_m = 0.0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< of the vehicle in the window's frame
  bool trusted = false;                                  ///< the sign is trusted
  double nees = 0.0;  ///< normalised estimation error squared of place and yaw; 4 is expected
  double position_error_m = 0.0, yaw_error_rad = 0.0, yaw_sigma_rad = 0.0;
  double relative_yaw_rad = 0.0;                ///< true yaw of the window against the vehicle
  double filtered_yaw_rad = 0.0;                ///< filtered yaw
  std::optional<double> single_yaw_rad;         ///< yaw from this image alone
  double width_error = 0.0, width_sigma = 0.0;  ///< relative
  double apparent_width_m = 0.0;                ///< from this image alone
  double nis = 0.0;                             ///< mean per degree of freedom over the window of images
};

/// Part of the opening's size given to the filter.
enum class SizeTold { kAll, kNothing };

/// Parameters of an estimator with this knowledge of a nominal size of 1.2 x 1.0 m.
estimation::PoseParams poseParams(SizeTold told);

/// Approach number `seed` of a campaign: start, window and all errors are random. A given size has the error
/// `FilterParams::kKnownSizeSigma`.
ApproachScript drawApproach(std::uint32_t seed, SizeTold told);

/// Flies to the end; one sample per image.
std::vector<FilterSample> follow(SyntheticApproach& approach, estimation::TargetEstimator& estimator,
                                 const geometry::OpeningSize& opening);

/// Mean normalised error squared of the samples whose sign is trusted; nothing if there are none.
std::optional<double> meanNees(const std::vector<FilterSample>& samples);

/// 95 % band of a mean of `count` independent chi squared numbers.
Interval chiSquaredBand(int degrees_of_freedom, int count);

}  // namespace window_ingress::evaluation
