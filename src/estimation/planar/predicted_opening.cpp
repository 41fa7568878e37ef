#include "estimation/planar/predicted_opening.hpp"

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation {

std::optional<PredictedOpening> predictOpening(const geometry::PinholeCamera& camera,
                                               const Eigen::Isometry3d& T_camera_window,
                                               const geometry::OpeningSize& size) {
  PredictedOpening predicted;
  const auto corners = geometry::openingCorners(size);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d turned = T_camera_window.linear() * corners[i];
    const Eigen::Vector3d p = turned + T_camera_window.translation();
    if (!(p.z() > 1e-3)) return std::nullopt;
    const double x = p.x() / p.z(), y = p.y() / p.z();
    Eigen::Matrix<double, 2, 3> by_point;
    by_point << camera.fx, 0, -camera.fx * x, 0, camera.fy, -camera.fy * y;
    by_point /= p.z();
    predicted.corners_px.segment<2>(2 * i) << camera.fx * x + camera.cx, camera.fy * y + camera.cy;
    predicted.by_pose.block<2, 3>(2 * i, 0) = by_point;
    predicted.by_pose.block<2, 3>(2 * i, 3) = -by_point * skew(turned);
    predicted.by_log_size.block<2, 1>(2 * i, 0) = by_point * T_camera_window.linear().col(1) * corners[i].y();
    predicted.by_log_size.block<2, 1>(2 * i, 1) = by_point * T_camera_window.linear().col(2) * corners[i].z();
  }
  return predicted;
}

Eigen::Isometry3d moved(const Eigen::Isometry3d& T, const Eigen::Matrix<double, 6, 1>& step) {
  const Eigen::Vector3d turn = step.tail<3>();
  const double angle = turn.norm();
  Eigen::Quaterniond rotation(T.linear());
  if (angle > 0.0) rotation = Eigen::AngleAxisd(angle, turn / angle) * rotation;
  return geometry::makePose(rotation.normalized().toRotationMatrix(), T.translation() + step.head<3>());
}

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return matrix;
}

}  // namespace window_ingress::estimation
