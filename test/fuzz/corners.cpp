#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"
#include "bytes.hpp"
#include "targets.hpp"
#include "window_ingress/estimation/target_estimator.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::fuzz {
namespace {

window_ingress::WindowDetection anyDetection(Bytes& bytes, double stamp_sec) {
  static const double kX[] = {220, 420, 420, 220}, kY[] = {150, 150, 310, 310};
  window_ingress::WindowDetection message;
  message.header.stamp = ros::Time(stamp_sec);
  message.detected = bytes.take<std::uint8_t>() % 16 > 0;
  const double spread = bytes.take<std::uint8_t>() % 4 * 100.0;  // near a window, or anywhere
  for (int i = 0; i < 4; ++i) {
    const std::uint8_t seen = bytes.take<std::uint8_t>();
    message.corners[i].visible = seen % 8 > 0;
    message.corners[i].x = kX[i] + bytes.number(-5.0 - spread, 5.0 + spread);
    message.corners[i].y = kY[i] + bytes.number(-5.0 - spread, 5.0 + spread);
    message.edges[i].visible = (seen & 16) > 0;
    message.edges[i].sigma_px = bytes.number(0.0, 1.0);
    message.edges[i].sigma_rad = bytes.number(0.0, 0.01);
  }
  for (int i = 0; i < 4; ++i) {
    const window_ingress::WindowCorner &corner = message.corners[i], &next = message.corners[(i + 1) % 4];
    message.edges[i].a_x = corner.x;
    message.edges[i].a_y = corner.y;
    message.edges[i].b_x = next.x + bytes.number(-1.0, 1.0);
    message.edges[i].b_y = next.y;
  }
  for (window_ingress::WindowCorner& corner : message.corners)
    for (double& number : corner.covariance) number = bytes.number(-0.5, 2.0);
  window_ingress::InteriorPoints& interior = message.interior;
  interior.key_stamp = ros::Time(stamp_sec - 1.0);
  interior.sigma_px = bytes.number(0.0, 1.0);
  interior.key_corners = message.corners;
  for (window_ingress::WindowCorner& corner : interior.key_corners) corner.x += 3.0;
  for (std::size_t i = bytes.below(40); i > 0; --i) {
    interior.id.push_back(bytes.take<std::uint16_t>());
    interior.key_x.push_back(static_cast<float>(bytes.number(0.0, 640.0)));
    interior.key_y.push_back(static_cast<float>(bytes.number(0.0, 480.0)));
    interior.x.push_back(static_cast<float>(bytes.number(0.0, 640.0)));
    interior.y.push_back(static_cast<float>(bytes.number(0.0, 480.0)));
    interior.normal_x.push_back(0.0F);
    interior.normal_y.push_back(0.0F);
    interior.beside.push_back(0);
  }
  return message;
}

void check(const estimation::PoseResult& result) {
  require(result.estimate.has_value() == (result.reject == estimation::PoseReject::kNone),
          "a pose or a reason");
  if (!result.estimate) return require(!result.detail.empty(), "a reason has words");
  const estimation::WindowPoseEstimate& pose = *result.estimate;
  require(geometry::isValidPose(pose.best.T_camera_window), "a rotation and finite numbers");
  require(pose.best.covariance.allFinite(), "a finite covariance");
  require(std::isfinite(pose.yaw_rad + pose.yaw_sigma_rad + pose.sigma_u_rad + pose.log_likelihood_ratio),
          "a finite yaw");
}

void check(const std::optional<estimation::FilteredWindow>& window) {
  if (!window) return;
  require(geometry::isValidPose(window->T_odom_window), "the filtered pose is one");
  require(window->covariance.allFinite(), "the filtered covariance is finite");
}

geometry::PinholeCamera anyCamera(Bytes& bytes) {
  auto camera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);
  if (bytes.take<std::uint8_t>() % 2 == 0) return camera;
  camera.fx = bytes.number(100.0, 1000.0);
  camera.cx = bytes.number(0.0, 640.0);
  for (double& d : camera.distortion) d = bytes.number(-0.3, 0.3);
  return camera;
}

std::optional<estimation::GravityPrior> anyGravity(Bytes& bytes) {
  if (bytes.take<std::uint8_t>() % 2 == 0) return std::nullopt;
  return estimation::GravityPrior{{bytes.number(-0.2, 0.2), bytes.number(-1.0, 0.0), bytes.number(-0.2, 0.2)},
                                  bytes.number(0.0, 0.1)};
}

}  // namespace

void corners(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const geometry::PinholeCamera camera = anyCamera(bytes);
  static const estimation::WindowPoseEstimator estimator{estimation::PoseParams()};
  const bool filtered = bytes.take<std::uint8_t>() % 16 == 0;  // takes much longer
  estimation::TargetEstimator tracker({}, {}, {});
  for (int i = 0; i < (filtered ? 3 : 1) && bytes.left() > 0; ++i) {
    const double stamp_sec = 100.0 + 0.05 * i;
    const auto window = adapters::fromMsg(anyDetection(bytes, stamp_sec));
    require(window.value.has_value() == window.reason.empty(), "an observation or a reason");
    if (!window) continue;
    check(estimator.estimate(*window.value, camera, {anyGravity(bytes)}));
    if (!filtered || !camera.validate().empty()) continue;
    const Eigen::Isometry3d T_odom_base =
        geometry::makePose(geometry::yawRotation(bytes.number(-0.2, 0.2)),
                           {bytes.number(-1.0, 1.0), bytes.number(-1.0, 1.0), 1.5});
    if (!geometry::isValidPose(T_odom_base)) continue;
    tracker.addOdometry(stamp_sec, T_odom_base, Eigen::Vector3d(bytes.number(-1.0, 1.0), 0.0, 0.0));
    tracker.addDetection(*window.value, camera,
                         geometry::makePose(geometry::R_optical_flu().transpose(), {0.1, 0.0, 0.0}));
    tracker.flush();
    check(tracker.lastUpdate().pose);
    check(tracker.filtered(stamp_sec));
  }
}

}  // namespace window_ingress::fuzz
