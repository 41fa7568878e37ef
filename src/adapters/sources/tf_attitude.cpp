#include "adapters/sources/tf_attitude.hpp"

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/conversions/stamps.hpp"

namespace window_ingress::adapters {

TfAttitude::TfAttitude(const tf2_ros::Buffer& tf, const std::string& odom_frame,
                       const std::string& base_frame)
    : tf_(tf),
      odom_frame_(odom_frame),
      base_frame_(base_frame),
      known_sec_(steadyNowSec()),
      asked_sec_(known_sec_ - 2.0 * kSilenceSec) {}

std::optional<Eigen::Quaterniond> TfAttitude::at(double stamp_sec) {
  asked_sec_ = steadyNowSec();
  try {
    const auto found = tf_.lookupTransform(odom_frame_, base_frame_, toStamp(stamp_sec));
    const auto rotation = fromMsg(found.transform.rotation);
    fault_ = rotation.reason;
    if (rotation) known_sec_ = asked_sec_;
    return rotation.value;
  } catch (const tf2::TransformException& error) {
    fault_ = error.what();
    return std::nullopt;
  }
}

Health TfAttitude::health() const {
  const double now_sec = steadyNowSec();
  const bool asked = now_sec - asked_sec_<kSilenceSec, lasts = now_sec - known_sec_> kSilenceSec;
  if (fault_.empty() || !asked || !lasts) return {};
  return {Health::kError, "no attitude: " + odom_frame_ + " <- " + base_frame_ +
                              " is not in tf at the time of the image: " + fault_};
}

}  // namespace window_ingress::adapters
