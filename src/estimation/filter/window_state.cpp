#include "estimation/filter/window_state.hpp"

#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kMinInverseHeight = 0.1;  // 1/m: larger openings are no windows

Eigen::Vector3d attitudeError(const WindowState& state) {
  return state.values.segment<3>(WindowState::kPitchBias);
}

Eigen::Matrix3d rotation(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (!(angle > 0.0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).matrix();
}

// exp(v + dv) = exp(J dv) exp(v).
Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  const Eigen::Matrix3d cross = skew(vector);
  if (angle < 1e-4) return Eigen::Matrix3d::Identity() + 0.5 * cross;
  const double square = angle * angle;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / square * cross +
         (angle - std::sin(angle)) / (square * angle) * cross * cross;
}

// Pose of the camera, corrected by the state's heading error and stamp delay.
Eigen::Isometry3d correctedCamera(const WindowState& state, const ScaledCamera& at) {
  const double late_sec = state.values(WindowState::kLate);
  const Eigen::Matrix3d R_turned = geometry::yawRotation(-state.values(WindowState::kHeadingBias)) *
                                   rotation(late_sec * at.motion.turn_radps);
  return geometry::makePose(R_turned * at.T_odom_camera.linear(),
                            at.T_odom_camera.translation() + late_sec * at.motion.velocity_mps);
}

// Derivative of the pose in the camera by a turn of the whole world about the camera's axes.
Eigen::Matrix<double, 6, 3> byCameraTurn(const Eigen::Isometry3d& T_camera_window) {
  Eigen::Matrix<double, 6, 3> turn;
  turn << -skew(T_camera_window.translation()), Eigen::Matrix3d::Identity();
  return turn;
}

Eigen::Matrix<double, 6, WindowState::kSize> poseByState(const WindowState& state, const ScaledCamera& at,
                                                         const Eigen::Isometry3d& T_camera_window,
                                                         const Eigen::Matrix3d& R_camera_odom) {
  Eigen::Matrix<double, 6, WindowState::kSize> jacobian =
      Eigen::Matrix<double, 6, WindowState::kSize>::Zero();
  const double height = state.heightM();
  jacobian.topLeftCorner<3, 3>() = height * R_camera_odom;
  jacobian.block<3, 1>(3, WindowState::kYaw) = R_camera_odom.col(2);
  jacobian.block<6, 3>(0, WindowState::kPitchBias) =
      byCameraTurn(T_camera_window) * leftJacobian(attitudeError(state));
  jacobian.col(WindowState::kHeadingBias) = byCameraTurn(T_camera_window) * R_camera_odom.col(2);
  const Eigen::Vector3d turn_radps =
      geometry::yawRotation(-state.values(WindowState::kHeadingBias)) * at.motion.turn_radps;
  jacobian.col(WindowState::kLate) = -byCameraTurn(T_camera_window) * R_camera_odom * turn_radps;
  jacobian.block<3, 1>(0, WindowState::kLate) -= R_camera_odom * at.motion.velocity_mps;
  jacobian.block<3, 1>(0, WindowState::kInverseHeight) =
      R_camera_odom * (-height * height * state.values.head<3>() + height * at.unscaled_m);
  return jacobian;
}

}  // namespace

Eigen::Isometry3d WindowState::T_odom_window() const {
  return geometry::makePose(geometry::yawRotation(yaw()), position());
}

Eigen::Isometry3d WindowState::T_camera_window(const Eigen::Isometry3d& T_odom_camera) const {
  const Eigen::Isometry3d unturned = T_odom_camera.inverse() * T_odom_window();
  return geometry::makePose(rotation(attitudeError(*this)), Eigen::Vector3d::Zero()) * unturned;
}

Eigen::Matrix<double, 4, WindowState::kSize> WindowState::poseByValues() const {
  Eigen::Matrix<double, 4, kSize> jacobian = Eigen::Matrix<double, 4, kSize>::Zero();
  const double height = heightM();
  jacobian.topLeftCorner<3, 3>().diagonal().setConstant(height);
  jacobian.block<3, 1>(0, kInverseHeight) = -height * height * values.head<3>();
  jacobian(3, kYaw) = 1.0;
  return jacobian;
}

WindowState::Vector difference(const WindowState::Vector& a, const WindowState::Vector& b) {
  WindowState::Vector out = a - b;
  out(WindowState::kYaw) = geometry::wrapAngle(out(WindowState::kYaw));
  return out;
}

std::optional<LinearisedView> linearise(const ImageMeasurement& image, const geometry::PinholeCamera& camera,
                                        const ScaledCamera& at, const WindowState& state) {
  if (!(state.values(WindowState::kInverseHeight) > kMinInverseHeight)) return std::nullopt;
  const Eigen::Isometry3d T_odom_camera = correctedCamera(state, at);
  const Eigen::Isometry3d T = state.T_camera_window(T_odom_camera);
  const auto predicted = predictOpening(camera, T, state.opening());
  if (!predicted) return std::nullopt;
  const Eigen::Matrix3d R_camera_odom = rotation(attitudeError(state)) * T_odom_camera.linear().transpose();
  Eigen::Matrix<double, 8, WindowState::kSize> corners_by_state =
      predicted->by_pose * poseByState(state, at, T, R_camera_odom);
  corners_by_state.col(WindowState::kLogAspect) += predicted->by_log_size.col(0);
  corners_by_state.col(WindowState::kInverseHeight) -=
      state.heightM() * (predicted->by_log_size.col(0) + predicted->by_log_size.col(1));
  Eigen::Matrix<double, 6, 6> pose_by_camera = Eigen::Matrix<double, 6, 6>::Zero();
  pose_by_camera.topLeftCorner<3, 3>().setIdentity();
  pose_by_camera.rightCols<3>() = byCameraTurn(T);
  const Eigen::Matrix<double, 8, 6> corners_by_camera = predicted->by_pose * pose_by_camera;

  const LinearisedResidual seen = image.evaluate(predicted->corners_px);
  return LinearisedView{seen.residual, seen.by_corners.lazyProduct(corners_by_state),
                        seen.by_corners.lazyProduct(corners_by_camera)};
}

}  // namespace window_ingress::estimation
