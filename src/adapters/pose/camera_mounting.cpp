#include "adapters/pose/camera_mounting.hpp"

#include <tf2_msgs/TFMessage.h>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/nodes.hpp"
#include "adapters/runtime/parameter_server.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kFarthest_m = 2.0;    // from the centre of a small vehicle
constexpr double kHalfTurn = 3.14160;  // [rad], rounded up
const char* const kNames[] = {"x", "y", "z", "yaw", "pitch", "roll"};

void checkRange(std::vector<double> pose) {
  std::vector<parameters::Field> fields;
  for (std::size_t i = 0; i < 6; ++i) {
    const double most = i < 3 ? kFarthest_m : kHalfTurn;
    const std::string unit = i < 3 ? " [m]" : " [rad, not degrees]";
    fields.push_back({std::string("pose: ") + kNames[i] + unit, &pose[i], -most, most});
  }
  refuseFaulty(parameters::faultsOf(fields));
}

}  // namespace

Eigen::Isometry3d T_base_cameraOf(const std::vector<double>& pose) {
  if (pose.size() != 6)
    throw InputError("pose has " + std::to_string(pose.size()) +
                     " numbers, must have six: [x, y, z, yaw, pitch, roll] in metres and radians");
  checkRange(pose);
  const Eigen::Matrix3d R_base_link = (Eigen::AngleAxisd(pose[3], Eigen::Vector3d::UnitZ()) *
                                       Eigen::AngleAxisd(pose[4], Eigen::Vector3d::UnitY()) *
                                       Eigen::AngleAxisd(pose[5], Eigen::Vector3d::UnitX()))
                                          .toRotationMatrix();
  return geometry::makePose(R_base_link * geometry::R_optical_flu().transpose(),
                            Eigen::Vector3d(pose[0], pose[1], pose[2]));
}

/// Publishes the camera's mounting on tf_static: base, camera_link (forward, left, up) and the optical frame.
class CameraMountingNode : public Node {
 public:
  CameraMountingNode(ros::NodeHandle& nh, const CameraMountingParams& params, const FrameNames& frames) {
    tf2_msgs::TFMessage message;
    message.transforms =
        mountingOf(T_base_cameraOf(params.pose), ros::Time::now(), frames, params.camera_frame);
    publisher_ = nh.advertise<tf2_msgs::TFMessage>("/tf_static", 1, true);
    publisher_.publish(message);
  }

 private:
  ros::Publisher publisher_;
};

std::unique_ptr<Node> makeCameraMounting(ros::NodeHandle& nh, ros::NodeHandle& pnh) {
  navigation::VehicleParams vehicle;
  const auto params = readParameters<CameraMountingParams>(nh, pnh, vehicle);
  return std::make_unique<CameraMountingNode>(nh, params, vehicle.frames);
}

}  // namespace window_ingress::adapters
