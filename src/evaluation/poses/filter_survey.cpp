#include "evaluation/poses/filter_survey.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::evaluation {
namespace {

constexpr double kEndM = 1.6;
constexpr double kScaleSigma = 0.5, kAspectSigma = 0.3;  // of an unknown size

// Of x, y, z and yaw.
Eigen::Matrix4d uprightCovariance(const estimation::Matrix6d& covariance) {
  Eigen::Matrix4d block;
  block << covariance.topLeftCorner<3, 3>(), covariance.block<3, 1>(0, 5), covariance.block<1, 3>(5, 0),
      covariance(5, 5);
  return block;
}

FilterSample compare(const estimation::FilteredWindow& found, const SyntheticApproach& approach,
                     const geometry::OpeningSize& opening) {
  const Eigen::Isometry3d truth = approach.T_odom_window();
  Eigen::Vector4d error;
  error << found.T_odom_window.translation() - truth.translation(),
      geometry::wrapAngle(geometry::yawOf(found.T_odom_window.linear()) - geometry::yawOf(truth.linear()));
  FilterSample sample;
  sample.trusted = found.sign_trusted;
  sample.nees = error.dot(uprightCovariance(found.covariance).ldlt().solve(error));
  sample.position_error_m = error.head<3>().norm();
  sample.yaw_error_rad = error(3);
  sample.yaw_sigma_rad = std::sqrt(found.covariance(5, 5));
  sample.width_error = found.size.size.width_m / opening.width_m - 1.0;
  sample.width_sigma = std::sqrt(found.size.log_covariance(0, 0));
  sample.nis = found.consistency.mean_nis;
  return sample;
}

}  // namespace

estimation::PoseParams poseParams(SizeTold told) {
  estimation::PoseParams params;
  if (told == SizeTold::kAll) return params;
  params.scale_sigma = kScaleSigma;
  params.aspect_sigma = kAspectSigma;
  return params;
}

ApproachScript drawApproach(std::uint32_t seed, SizeTold told) {
  simulation::RandomStream random(seed, "approach");
  const double side = random.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0;
  const double distance_m = random.uniform(4.0, 6.0), off_axis_rad = side * random.uniform(0.05, 0.6);
  ApproachScript script = ontoAxisAndIn(distance_m, off_axis_rad, random.uniform(-0.3, 0.3), kEndM);
  const double sigma = estimation::FilterParams::kKnownSizeSigma;
  if (told == SizeTold::kAll)
    script.opening = {1.2 * (1.0 + random.normal(sigma)), 1.0 * (1.0 + random.normal(sigma))};
  else
    script.opening = {random.uniform(0.8, 1.8), random.uniform(0.8, 1.4)};
  return script;
}

std::vector<FilterSample> follow(SyntheticApproach& approach, estimation::TargetEstimator& estimator,
                                 const geometry::OpeningSize& opening) {
  std::vector<FilterSample> samples;
  while (approach.advance()) {
    for (const auto& odometry : approach.odometry())
      estimator.addOdometry(odometry.stamp_sec, odometry.T_odom_base, odometry.velocity_odom_mps);
    if (!approach.isInView()) continue;
    estimator.addDetection(approach.window(), approach.camera(), approach.T_base_camera());
    const auto found = estimator.filtered(approach.timeSec());
    if (!found) continue;
    FilterSample sample = compare(*found, approach, opening);
    sample.time_sec = approach.timeSec();
    sample.flown_m = approach.flownM();
    sample.position_m = approach.positionM();
    sample.relative_yaw_rad = approach.relativeYawRad();
    sample.filtered_yaw_rad = geometry::wrapAngle(sample.relative_yaw_rad + sample.yaw_error_rad);
    if (const auto& single = estimator.lastUpdate().pose.estimate) {
      sample.single_yaw_rad = single->yaw_rad;
      sample.apparent_width_m = single->opening_width_m;
    }
    samples.push_back(sample);
  }
  return samples;
}

std::optional<double> meanNees(const std::vector<FilterSample>& samples) {
  std::vector<double> nees;
  for (const FilterSample& sample : samples)
    if (sample.trusted) nees.push_back(sample.nees);
  return nees.empty() ? std::nullopt : std::optional(mean(nees));
}

// Sums of chi squared numbers are chi squared; by Wilson and Hilferty its cube root is nearly normal.
Interval chiSquaredBand(int degrees_of_freedom, int count) {
  const double n = static_cast<double>(degrees_of_freedom) * count, spread = std::sqrt(2.0 / (9.0 * n));
  const auto bound = [&](double normal) { return n * std::pow(1.0 - spread * spread + normal * spread, 3); };
  return {bound(-1.96) / count, bound(1.96) / count};
}

}  // namespace window_ingress::evaluation
