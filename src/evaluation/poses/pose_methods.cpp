#include "evaluation/poses/pose_methods.hpp"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::evaluation {
namespace {

std::vector<cv::Point3d> planeCorners(const geometry::OpeningSize& opening) {
  const double x = 0.5 * opening.width_m, y = 0.5 * opening.height_m;
  return {{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}};
}

Eigen::Matrix3d eigenOf(const cv::Matx33d& m) { return Eigen::Map<const Eigen::Matrix3d>(m.val).transpose(); }

std::optional<Eigen::Isometry3d> windowPose(const Eigen::Matrix3d& R_camera_plane, const Eigen::Vector3d& t) {
  const Eigen::Isometry3d pose = geometry::makePose(R_camera_plane * geometry::R_optical_flu(), t);
  if (!geometry::isValidPose(pose)) return std::nullopt;
  return pose;
}

std::optional<Eigen::Isometry3d> byPnp(int flag, const std::vector<cv::Point2d>& image, const cv::Matx33d& K,
                                       const std::vector<double>& distortion,
                                       const geometry::OpeningSize& opening) {
  std::vector<cv::Mat> rotations, translations;
  if (cv::solvePnPGeneric(planeCorners(opening), image, K, distortion, rotations, translations, false,
                          static_cast<cv::SolvePnPMethod>(flag)) < 1)
    return std::nullopt;
  cv::Matx33d R;
  cv::Rodrigues(rotations[0], R);
  const cv::Mat& t = translations[0];
  return windowPose(eigenOf(R), {t.at<double>(0), t.at<double>(1), t.at<double>(2)});
}

std::optional<Eigen::Isometry3d> byHomography(const std::vector<cv::Point2d>& image, const cv::Matx33d& K,
                                              const std::vector<double>& distortion,
                                              const geometry::OpeningSize& opening) {
  std::vector<cv::Point2d> normalised, plane;
  cv::undistortPoints(image, normalised, K, distortion);
  for (const cv::Point3d& corner : planeCorners(opening)) plane.emplace_back(corner.x, corner.y);
  const cv::Mat homography = cv::findHomography(plane, normalised);
  if (homography.empty()) return std::nullopt;
  const Eigen::Matrix3d H = eigenOf(cv::Matx33d(homography.ptr<double>()));
  const double length = 0.5 * (H.col(0).norm() + H.col(1).norm()) * (H(2, 2) < 0.0 ? -1.0 : 1.0);
  cv::Matx33d columns;
  const Eigen::Vector3d r1 = H.col(0) / length, r2 = H.col(1) / length, r3 = r1.cross(r2);
  for (int i = 0; i < 3; ++i) columns(i, 0) = r1(i), columns(i, 1) = r2(i), columns(i, 2) = r3(i);
  cv::Matx31d values;
  cv::Matx33d u, vt;
  cv::SVD::compute(columns, values, u, vt);
  return windowPose(eigenOf(u * vt), H.col(2) / length);
}

}  // namespace

const char* toString(PeerMethod method) {
  constexpr const char* kNames[kPeerMethods] = {"iterative", "ippe", "homography"};
  return kNames[static_cast<std::size_t>(method)];
}

std::optional<Eigen::Isometry3d> poseByPeer(PeerMethod method, const geometry::Quadrilateral& corners,
                                            const geometry::PinholeCamera& camera,
                                            const geometry::OpeningSize& opening) {
  std::vector<cv::Point2d> image;
  for (const Eigen::Vector2d& corner : corners) image.emplace_back(corner.x(), corner.y());
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  try {
    if (method == PeerMethod::kHomography) return byHomography(image, K, distortion, opening);
    const int flag = method == PeerMethod::kIppe ? cv::SOLVEPNP_IPPE : cv::SOLVEPNP_ITERATIVE;
    return byPnp(flag, image, K, distortion, opening);
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
}

}  // namespace window_ingress::evaluation
