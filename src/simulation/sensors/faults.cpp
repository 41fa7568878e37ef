#include "simulation/sensors/faults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::simulation {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kWildSpeed_mps = 3.0, kWildYawRate_radps = 2.0;

const Eigen::Vector3d nanVector() { return Eigen::Vector3d::Constant(kNan); }

bool isGarbage(const FaultParams& fault) { return fault.kind == "garbage"; }

bool actsAt(const FaultParams& fault, double now_sec) {
  return now_sec + 1e-9 >= fault.at_sec && now_sec + 1e-9 < fault.at_sec + fault.duration_sec;
}

}  // namespace

void FaultPlan::inject(FaultParams fault, double now_sec) {
  auto wrong = parameters::outOfRange(fault);
  const std::string why_not = whyNoSuchFault(fault);
  if (wrong.empty() && !why_not.empty()) wrong.push_back(why_not);
  if (!wrong.empty()) throw InputError("fault: " + parameters::joined(wrong));
  fault.at_sec = now_sec;
  faults_.push_back(fault);
}

const FaultParams* FaultPlan::acting(const std::string& unit, double now_sec) const {
  const FaultParams* latest = nullptr;
  for (const FaultParams& fault : faults_)
    if (fault.unit == unit && fault.kind != "slide" && actsAt(fault, now_sec) &&
        (!latest || fault.at_sec >= latest->at_sec))
      latest = &fault;
  return latest;
}

Eigen::Vector3d FaultPlan::slideAt(double now_sec) const {
  Eigen::Vector3d slide_m = Eigen::Vector3d::Zero();
  for (const FaultParams& fault : faults_) {
    if (fault.kind != "slide") continue;
    const double slid_m = fault.slide_mps * std::clamp(now_sec - fault.at_sec, 0.0, fault.duration_sec);
    slide_m += slid_m * Eigen::Vector3d(std::cos(fault.direction_rad), std::sin(fault.direction_rad), 0.0);
  }
  return slide_m;
}

Exposure FaultEffects::repeat(const Exposure& old, Exposure fresh) const {
  fresh.index = old.index;
  fresh.shown = old.shown;
  return fresh;
}

OdometrySample FaultEffects::repeat(OdometrySample old, const OdometrySample& fresh) const {
  old.stamp_sec = fresh.stamp_sec;
  return old;
}

ImuSample FaultEffects::repeat(ImuSample old, const ImuSample& fresh) const {
  old.stamp_sec = fresh.stamp_sec;
  return old;
}

void FaultEffects::spoil(Exposure& exposure, const FaultParams& fault) const {
  exposure.spoilt = isGarbage(fault) ? Exposure::Spoilt::kGarbage : Exposure::Spoilt::kMirrored;
}

void spoil(cv::Mat& image, const Exposure& exposure, std::uint32_t seed) {
  if (exposure.spoilt == Exposure::Spoilt::kMirrored) cv::flip(image, image, 1);
  if (exposure.spoilt != Exposure::Spoilt::kGarbage) return;
  const std::string name = "image garbage of picture " + std::to_string(exposure.index);
  cv::RNG(RandomStream(seed, name).bits()).fill(image, cv::RNG::UNIFORM, 0, 256);
}

void FaultEffects::spoil(OdometrySample& sample, const FaultParams& fault) const {
  if (isGarbage(fault)) {
    sample.T_odom_base.translation() = nanVector();
    sample.velocity_odom_mps = sample.angular_velocity_base_radps = nanVector();
    return;
  }
  const Eigen::Matrix3d turn = geometry::yawRotation(fault.turn_rad);
  const Eigen::Vector3d jumped = sample.T_odom_base.translation() + Eigen::Vector3d(fault.jump_m, 0.0, 0.0);
  sample.T_odom_base = geometry::makePose(turn * sample.T_odom_base.linear(), jumped);
  sample.velocity_odom_mps = turn * sample.velocity_odom_mps;
}

void FaultEffects::spoil(ImuSample& sample, const FaultParams& fault) const {
  if (isGarbage(fault)) {
    sample.R_odom_base.coeffs().setConstant(kNan);
    sample.angular_velocity_base_radps = sample.specific_force_base_mps2 = nanVector();
    return;
  }
  const Eigen::Quaterniond roll(Eigen::AngleAxisd(fault.tilt_rad, Eigen::Vector3d::UnitX()));
  sample.R_odom_base = (sample.R_odom_base * roll).normalized();
  sample.specific_force_base_mps2 = roll.conjugate() * sample.specific_force_base_mps2;
}

void FaultEffects::spoil(CalibrationSample& sample, const FaultParams& fault) const {
  const double factor = isGarbage(fault) ? kNan : fault.zoom;
  sample.camera.fx *= factor;
  sample.camera.fy *= factor;
}

void FaultEffects::spoil(double& time_sec, const FaultParams& fault) const { time_sec -= fault.back_sec; }

void FaultEffects::spoil(VelocityCommand& command, const FaultParams& fault) {
  if (!isGarbage(fault)) {
    command = {-command.velocity_odom_mps, -command.yaw_rate_radps};
    return;
  }
  for (int i = 0; i < 3; ++i) command.velocity_odom_mps[i] = random.uniform(-kWildSpeed_mps, kWildSpeed_mps);
  command.yaw_rate_radps = random.uniform(-kWildYawRate_radps, kWildYawRate_radps);
}

}  // namespace window_ingress::simulation
