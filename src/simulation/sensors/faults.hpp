#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "simulation/random_stream.hpp"
#include "simulation/scenario/fault_params.hpp"
#include "simulation/sensors/imu_sensor.hpp"
#include "simulation/sensors/odometry_sensor.hpp"
#include "simulation/vehicle/quadrotor.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// The way of one kind of data out of the world or into it: what is put in comes out at once, unless a fault
/// acts. Then some of it is lost, late, repeated or spoiled. Times must not decrease.
///
/// `Traits::repeat(old, fresh)`: the old value as it is said again in place of the fresh one.
/// `Traits::spoil(value, fault)`: for the kinds "garbage" and "wrong".
///
/// When a fault ends, what it still held back is lost: order is kept, and nothing of it is felt later on.
template <typename Value, typename Traits>
class FaultLine {
 public:
  explicit FaultLine(Traits traits = {}) : traits_(std::move(traits)) {}

  /// \param fault what acts now, or none
  void put(double now_sec, Value value, const FaultParams* fault) {
    notice(fault);
    if (fault == nullptr) {
      before_ = value;
      makeReady(std::move(value));
    } else if (passes(now_sec, *fault)) {
      change(value, *fault);
      const double due_sec = fault->kind == "delayed" ? now_sec + fault->delay_sec : now_sec;
      held_.emplace_back(due_sec, std::move(value));
    }
  }

  /// The next of what has arrived by now, in order; to be called until there is nothing.
  std::optional<Value> take(double now_sec, const FaultParams* fault) {
    notice(fault);
    for (; !held_.empty() && held_.front().first <= now_sec + 1e-9; held_.pop_front())
      makeReady(std::move(held_.front().second));
    if (ready_.empty()) return std::nullopt;
    std::optional<Value> first = std::move(ready_.front());
    ready_.pop_front();
    return first;
  }

 private:
  static constexpr std::size_t kMaxReady = 1000;  // what nobody takes is forgotten

  void makeReady(Value value) {
    ready_.push_back(std::move(value));
    if (ready_.size() > kMaxReady) ready_.pop_front();
  }

  void notice(const FaultParams* fault) {
    if (fault == acting_) return;
    acting_ = fault;
    held_.clear();
    next_sec_ = -1.0;
  }

  bool passes(double now_sec, const FaultParams& fault) {
    if (fault.kind == "off") return false;
    if (fault.kind == "intermittent")
      return std::fmod(now_sec - fault.at_sec + 1e-9, fault.off_sec + fault.on_sec) >= fault.off_sec;
    if (fault.kind != "slow") return true;
    if (now_sec + 1e-9 < next_sec_) return false;
    next_sec_ = now_sec + 1.0 / fault.rate_hz;
    return true;
  }

  void change(Value& value, const FaultParams& fault) {
    if (fault.kind == "stuck") {
      if (!before_) before_ = value;  // stuck from the start: the first is repeated
      value = traits_.repeat(*before_, value);
    } else if (fault.kind == "garbage" || fault.kind == "wrong") {
      traits_.spoil(value, fault);
    }
  }

  Traits traits_;
  const FaultParams* acting_ = nullptr;
  std::optional<Value> before_;
  double next_sec_ = -1.0;
  std::deque<std::pair<double, Value>> held_;
  std::deque<Value> ready_;
};

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

/// Sensors that say the same again under new stamps.
template <typename Sample>
struct Restamped {
  Sample repeat(const Sample& old, const Sample& fresh) const {
    Sample again = old;
    again.stamp_sec = fresh.stamp_sec;
    return again;
  }
};

struct ImageTraits {
  Exposure repeat(const Exposure& old, const Exposure& fresh) const;
  void spoil(Exposure& exposure, const FaultParams& fault) const;
};

/// Does to the image what the exposure says.
void spoil(cv::Mat& image, const Exposure& exposure, std::uint32_t seed);

/// Odometry, and the transform made of it.
struct OdometryTraits : Restamped<OdometrySample> {
  void spoil(OdometrySample& sample, const FaultParams& fault) const;
};

struct ImuTraits : Restamped<ImuSample> {
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
