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
#include "simulation/scenario/sensor_params.hpp"
#include "simulation/schedule.hpp"
#include "simulation/sensors/imu_sensor.hpp"
#include "simulation/sensors/odometry_sensor.hpp"
#include "simulation/vehicle/quadrotor.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// One exposure on its way to an image.
struct Exposure {
  std::uint64_t index = 0;  ///< number of the shown image, for its noise
  double stamp_sec = 0.0;
  VehicleTruth truth;  ///< at the stamp
  VehicleTruth shown;  ///< vehicle as shown in the image, relative to a house at its resting place
  enum class Spoilt { kNot, kGarbage, kMirrored } spoilt = Spoilt::kNot;
};

/// The content of camera_info for an image.
struct CalibrationSample {
  double stamp_sec = 0.0;
  geometry::PinholeCamera camera;
};

/// Effects of faults on the values of each kind.
struct FaultEffects {
  /// The old value in the form in which it replaces the fresh one.
  Exposure repeat(const Exposure& old, Exposure fresh) const;
  OdometrySample repeat(OdometrySample old, const OdometrySample& fresh) const;
  ImuSample repeat(ImuSample old, const ImuSample& fresh) const;
  template <typename Value>
  Value repeat(const Value& old, const Value&) const {
    return old;
  }

  /// For the kinds "garbage" and "wrong".
  void spoil(Exposure& exposure, const FaultParams& fault) const;
  void spoil(OdometrySample& sample, const FaultParams& fault) const;
  void spoil(ImuSample& sample, const FaultParams& fault) const;
  void spoil(CalibrationSample& sample, const FaultParams& fault) const;
  void spoil(double& time_sec, const FaultParams& fault) const;  ///< the clock
  void spoil(VelocityCommand& command, const FaultParams& fault);

  RandomStream random{0, "garbage"};  ///< of commands
};

/// Applies `exposure.spoilt` to the image.
void spoil(cv::Mat& image, const Exposure& exposure, std::uint32_t seed);

/// The path of one kind of data out of the world or into it. Without a fault, values pass at once. During a
/// fault values are lost, late, repeated or spoiled. Times must not decrease.
///
/// The end of a fault discards the values that are still delayed: this keeps the order and leaves no later
/// effect.
template <typename Value, typename Effects = FaultEffects>
class FaultLine {
 public:
  explicit FaultLine(Effects effects = {}) : effects_(std::move(effects)) {}

  /// \param fault the acting fault, or null
  void put(double now_sec, Value value, const FaultParams* fault) {
    notice(fault);
    if (fault == nullptr) {
      before_ = value;
      makeReady(std::move(value));
    } else if (passes(now_sec, *fault)) {
      change(value, *fault);
      const double due_sec = fault->kind == "delayed" ? now_sec + fault->delay_sec : now_sec;
      held_.push(due_sec, std::move(value));
    }
  }

  /// The next value that has arrived, in order; call until empty.
  std::optional<Value> take(double now_sec, const FaultParams* fault) {
    notice(fault);
    while (auto due = held_.take(now_sec)) makeReady(std::move(*due));
    if (ready_.empty()) return std::nullopt;
    std::optional<Value> first = std::move(ready_.front());
    ready_.pop_front();
    return first;
  }

 private:
  static constexpr std::size_t kMaxReady = 1000;  // older values that nobody takes are dropped

  void makeReady(Value value) {
    ready_.push_back(std::move(value));
    if (ready_.size() > kMaxReady) ready_.pop_front();
  }

  void notice(const FaultParams* fault) {
    if (fault == acting_) return;
    acting_ = fault;
    held_ = {};
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
      if (!before_) before_ = value;  // stuck from the start: repeats the first value
      value = effects_.repeat(*before_, value);
    } else if (fault.kind == "garbage" || fault.kind == "wrong") {
      effects_.spoil(value, fault);
    }
  }

  Effects effects_;
  const FaultParams* acting_ = nullptr;
  std::optional<Value> before_;
  double next_sec_ = -1.0;
  DelayLine<Value> held_;
  std::deque<Value> ready_;
};

/// All faults of a world: from the scenario, and injected later.
class FaultPlan {
 public:
  explicit FaultPlan(const std::vector<FaultParams>& faults) : faults_(faults.begin(), faults.end()) {}

  /// Begins now, whatever its `at_sec`. \throws InputError if the fault is out of range or impossible
  void inject(FaultParams fault, double now_sec);

  /// The fault acting on this unit at this time: the one that began last, or of several such the last in the
  /// list. Returns the same object while the fault acts.
  const FaultParams* acting(const std::string& unit, double now_sec) const;
  /// Total shift of odometry's position by all slides up to this time; it stays after they end [m].
  Eigen::Vector3d slideAt(double now_sec) const;

 private:
  std::deque<FaultParams> faults_;  // a deque, because acting faults must keep their addresses
};

}  // namespace window_ingress::simulation
