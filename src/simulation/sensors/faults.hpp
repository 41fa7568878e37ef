#pragma once

#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "simulation/random_stream.hpp"
#include "simulation/scenario/fault_params.hpp"
#include "simulation/sensors/fault_line.hpp"
#include "simulation/sensors/imu_sensor.hpp"
#include "simulation/sensors/odometry_sensor.hpp"
#include "simulation/vehicle/quadrotor.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// All faults of a world: those of its scenario and those injected meanwhile.
class FaultPlan {
 public:
  explicit FaultPlan(const std::vector<FaultParams>& faults) : faults_(faults.begin(), faults.end()) {}

  /// \throws InputError if it is out of range or there can be no such fault
  void inject(const FaultParams& fault);

  /// What acts on this unit at this time: of several the one that began last, of those the last named. Stays
  /// the same object while it acts.
  const FaultParams* acting(const std::string& unit, double now_sec) const;
  /// How far all slides together have moved the position of odometry by this time; it stays where it slid to
  /// [m].
  Eigen::Vector3d slideAt(double now_sec) const;

 private:
  std::deque<FaultParams> faults_;  // a deque: those that act keep their address
};

/// A moment at which the shutter was open, on its way to the image.
struct Exposure {
  std::uint64_t index = 0;  ///< of the image that is shown, for its noise
  double stamp_sec = 0.0;
  VehicleTruth truth;  ///< at the stamp
  VehicleTruth shown;  ///< from where the image shows the world, as beside a house at its resting place
  enum class Spoilt { kNot, kGarbage, kMirrored } spoilt = Spoilt::kNot;
};

struct ImageTraits {
  Exposure repeat(const Exposure& old, const Exposure& fresh) const;
  void spoil(Exposure& exposure, const FaultParams& fault) const;
};

/// Does to the image what the exposure says.
void spoil(cv::Mat& image, const Exposure& exposure, std::uint32_t seed);

/// Odometry, and the transform made of it.
struct OdometryTraits {
  OdometrySample repeat(const OdometrySample& old, const OdometrySample& fresh) const;
  void spoil(OdometrySample& sample, const FaultParams& fault) const;
};

struct ImuTraits {
  ImuSample repeat(const ImuSample& old, const ImuSample& fresh) const;
  void spoil(ImuSample& sample, const FaultParams& fault) const;
};

/// What stands in camera_info beside an image.
struct CalibrationSample {
  double stamp_sec = 0.0;
  geometry::PinholeCamera camera;
};

struct CalibrationTraits {
  CalibrationSample repeat(const CalibrationSample& old, const CalibrationSample&) const { return old; }
  void spoil(CalibrationSample& sample, const FaultParams& fault) const;
};

struct ClockTraits {
  double repeat(double old, double) const { return old; }
  void spoil(double& time_sec, const FaultParams& fault) const { time_sec -= fault.back_sec; }
};

struct CommandTraits {
  VelocityCommand repeat(const VelocityCommand& old, const VelocityCommand&) const { return old; }
  void spoil(VelocityCommand& command, const FaultParams& fault);
  RandomStream random;
};

using ImageLine = FaultLine<Exposure, ImageTraits>;
using OdometryLine = FaultLine<OdometrySample, OdometryTraits>;
using ImuLine = FaultLine<ImuSample, ImuTraits>;
using CalibrationLine = FaultLine<CalibrationSample, CalibrationTraits>;
using ClockLine = FaultLine<double, ClockTraits>;
using CommandLine = FaultLine<VelocityCommand, CommandTraits>;

}  // namespace window_ingress::simulation
