#include "adapters/world/world_messages.hpp"

#include "adapters/images/image_conversion.hpp"
#include "simulation/camera/reference_image.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters {

nav_msgs::Odometry toOdometryMsg(const simulation::VehicleTruth& truth, const ros::Time& stamp,
                                 const FrameNames& frames) {
  nav_msgs::Odometry message;
  message.header = headerOf(stamp, frames.odom);
  message.child_frame_id = frames.base;
  message.pose.pose = toPoseMsg(truth.T_odom_base);
  message.twist.twist.linear = toVectorMsg(truth.T_odom_base.linear().transpose() * truth.velocity_odom_mps);
  message.twist.twist.angular = toVectorMsg(truth.angular_velocity_base_radps);
  return message;
}

nav_msgs::Odometry toOdometryMsg(const simulation::OdometrySample& sample, const ros::Time& stamp,
                                 const FrameNames& frames, bool twist_in_odom) {
  const simulation::VehicleTruth told{sample.T_odom_base, sample.velocity_odom_mps,
                                      sample.angular_velocity_base_radps};
  nav_msgs::Odometry message = toOdometryMsg(told, stamp, frames);
  if (twist_in_odom) message.twist.twist.linear = toVectorMsg(sample.velocity_odom_mps);
  return message;
}

window_ingress::ReferenceImage toReferenceMsg(const simulation::World& world,
                                              const std_msgs::Header& header) {
  geometry::Quadrilateral corners;
  window_ingress::ReferenceImage message;
  message.image = *toImageMsg(simulation::referenceImage(world.scenario(), &corners), header);
  for (std::size_t i = 0; i < 4; ++i) {
    message.corner_x[i] = corners[i].x();
    message.corner_y[i] = corners[i].y();
  }
  return message;
}

sensor_msgs::Imu toImuMsg(const simulation::ImuSample& sample, const ros::Time& stamp,
                          const FrameNames& frames) {
  sensor_msgs::Imu message;
  message.header = headerOf(stamp, frames.base);
  message.orientation =
      toPoseMsg(geometry::makePose(sample.R_odom_base.toRotationMatrix(), Eigen::Vector3d::Zero()))
          .orientation;
  message.angular_velocity = toVectorMsg(sample.angular_velocity_base_radps);
  message.linear_acceleration = toVectorMsg(sample.specific_force_base_mps2);
  return message;
}

geometry_msgs::PoseStamped toPoseStampedMsg(const Eigen::Isometry3d& pose, const std_msgs::Header& header) {
  geometry_msgs::PoseStamped message;
  message.header = header;
  message.pose = toPoseMsg(pose);
  return message;
}

std::string checkedUrl(const std::string& url) {
  for (const char* scheme : {"file:///", "package://"})
    if (url.rfind(scheme, 0) == 0) return url;
  if (!url.empty())
    throw InputError("camera_info_url is '" + url + "', must begin with file:/// or package://");
  return url;
}

}  // namespace window_ingress::adapters
