#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "evaluation/poses/synthetic_approach.hpp"
#include "evaluation/statistics.hpp"
#include "window_ingress/estimation/target_estimator.hpp"

namespace window_ingress::evaluation {

/// What the filter said after one image of a synthetic approach, beside the truth.
struct FilterSample {
  double time_sec = 0.0, flown_m = 0.0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< of the vehicle in the window's frame
  bool trusted = false;                                  ///< the sign
  double nees = 0.0;  ///< normalised estimation error squared of place and yaw; 4 is expected
  double position_error_m = 0.0, yaw_error_rad = 0.0, yaw_sigma_rad = 0.0;
  double relative_yaw_rad = 0.0;                ///< of the window against the vehicle, true
  double filtered_yaw_rad = 0.0;                ///< the same, as filtered
  std::optional<double> single_yaw_rad;         ///< and as this image alone says
  double width_error = 0.0, width_sigma = 0.0;  ///< relative
  double apparent_width_m = 0.0;                ///< of this image alone
  double nis = 0.0;                             ///< mean a degree of freedom over the window of images
};

/// What of the opening's size the filter is told.
enum class SizeTold { kAll, kNothing };

/// Parameters of an estimator that is told this much, by a nominal size of 1.2 x 1.0 m.
estimation::PoseParams poseParams(SizeTold told);

/// Approach number `seed` of a campaign: start, window and all errors are drawn. A size that is told is wrong
/// by `FilterParams::kKnownSizeSigma`.
ApproachScript drawApproach(std::uint32_t seed, SizeTold told);

/// Flies to the end; a sample an image.
std::vector<FilterSample> follow(SyntheticApproach& approach, estimation::TargetEstimator& tracker,
                                 const geometry::OpeningSize& opening);

/// Mean normalised error squared of the samples whose sign is trusted; nothing if there are none.
std::optional<double> meanNees(const std::vector<FilterSample>& samples);

/// 95 % band of a mean of `count` independent chi squared numbers.
Interval chiSquaredBand(int degrees_of_freedom, int count);

}  // namespace window_ingress::evaluation
