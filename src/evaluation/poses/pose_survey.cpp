#include "evaluation/poses/pose_survey.hpp"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "estimation/planar/relative_yaw.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::evaluation {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

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

constexpr int kTries = 1000;
constexpr double kMarginPx = 2.0;

/// The estimator trusts the borders' stated spreads and refuses as little as possible.
estimation::WindowPoseEstimator estimatorFor(const PoseSurveySetup& setup) {
  estimation::PoseParams params;
  params.opening_width_m = setup.opening.width_m;
  params.opening_height_m = setup.opening.height_m;
  params.systematic_sigma_px = 0.001;
  params.max_reprojection_rms_px = 50.0;
  params.max_range_m = 200.0;
  params.max_tilt_rad = 1.5;
  params.max_yaw_rad = 1.55;
  return estimation::WindowPoseEstimator(params);
}

struct View {
  Isometry3d T_camera_window;
  Vector3d up_camera;
  double yaw_sign;
};

class Draws {
 public:
  Draws(const PoseSurveySetup& setup, const PoseCell& cell, std::uint32_t seed)
      : setup_(setup), cell_(cell), random_(seed) {}

  std::optional<View> view() {
    for (int i = 0; i < kTries; ++i) {
      const View drawn = any();
      const auto corners = geometry::projectOpening(setup_.camera, drawn.T_camera_window, setup_.opening);
      if (corners && std::all_of(corners->begin(), corners->end(), [&](const auto& corner) {
            return setup_.camera.contains(corner, kMarginPx);
          }))
        return drawn;
    }
    return std::nullopt;
  }

  Vector3d disturbed(const Vector3d& up) {
    std::normal_distribution<double> noise(0.0, setup_.attitude_sigma_rad);
    return (up + Vector3d(noise(random_), noise(random_), noise(random_))).normalized();
  }

  std::mt19937& random() { return random_; }

 private:
  double within(double largest) { return std::uniform_real_distribution<double>(-largest, largest)(random_); }

  View any() {
    const double sign = within(1.0) < 0.0 ? -1.0 : 1.0;
    const Eigen::Matrix3d tilt = (AngleAxisd(within(setup_.largest_tilt_rad), Vector3d::UnitZ()) *
                                  AngleAxisd(within(setup_.largest_tilt_rad), Vector3d::UnitX()))
                                     .toRotationMatrix();
    const double bearing = within(setup_.largest_bearing_rad);  // to the right
    const Vector3d level(std::sin(bearing), 0.5 * std::sin(within(setup_.largest_bearing_rad)),
                         std::cos(bearing));
    const Eigen::Matrix3d R =
        geometry::R_optical_flu() * geometry::yawRotation(sign * cell_.yaw_rad - bearing);
    return {geometry::makePose(tilt * R, tilt * (cell_.distance_m * level.normalized())),
            tilt * -Vector3d::UnitY(), sign};
  }

  const PoseSurveySetup& setup_;
  const PoseCell& cell_;
  std::mt19937 random_;
};

double yawError(const Isometry3d& truth, const Isometry3d& pose) {
  return geometry::yawOf(truth.linear().transpose() * pose.linear());
}

void addTo(MethodErrors& errors, const View& view, const std::optional<Isometry3d>& pose) {
  if (!pose) {
    ++errors.failed;
    return;
  }
  ++errors.count;
  errors.yaw_squares += std::pow(yawError(view.T_camera_window, *pose), 2);
  const double lateral = pose->inverse().translation().y() - view.T_camera_window.inverse().translation().y();
  errors.lateral_squares += lateral * lateral;
  if (estimation::yawFromSight(*pose, view.up_camera) * view.yaw_sign < 0.0) ++errors.wrong_signs;
}

void addTrust(PoseCellResult& result, const View& view, const estimation::WindowPoseEstimate& estimate) {
  const double error = yawError(view.T_camera_window, estimate.best.T_camera_window);
  if (estimate.sign_trusted) {
    const Vector3d up = -Vector3d::UnitY();  // the camera's own: the estimate was given no attitude
    const double true_yaw = estimation::relativeYaw(view.T_camera_window.linear(), up).yaw_rad;
    const double from_sight = estimation::yawFromSight(view.T_camera_window, up);
    ++result.trusted;
    result.trusted_yaw_squares += error * error;
    if (estimate.yaw_from_sight_rad * from_sight < 0.0 || estimate.yaw_rad * true_yaw < 0.0)
      ++result.trusted_wrong;
  }
  double squares = error * error / std::pow(estimate.yaw_sigma_rad, 2);
  if (estimate.alternative) {
    const auto yaw = estimation::relativeYaw(estimate.alternative->T_camera_window.linear(), {0, -1, 0});
    const double other = yawError(view.T_camera_window, estimate.alternative->T_camera_window);
    if (std::abs(other) < std::abs(error))
      squares = std::pow(other / estimation::yawSigma(yaw, estimate.alternative->covariance), 2);
  }
  result.yaw_consistency += squares;
}

void addBound(PoseCellResult& result, const PoseBound& bound) {
  result.yaw_bound_rad += bound.yaw_rad * bound.yaw_rad;
  result.lateral_bound_m += bound.lateral_m * bound.lateral_m;
  result.sigma_u_rad += bound.sigma_u_rad * bound.sigma_u_rad;
}

void finish(PoseCellResult& result) {
  const double draws = std::max(1, result.draws);
  for (double* squares : {&result.yaw_bound_rad, &result.lateral_bound_m, &result.sigma_u_rad})
    *squares = std::sqrt(*squares / draws);
  result.yaw_consistency /= std::max(1, result.methods[kOurs].count);
}

}  // namespace

const char* nameOfMethod(int method) {
  constexpr const char* kNames[kPoseMethods] = {"ours", "ours_attitude", "iterative", "ippe", "homography"};
  return kNames[method];
}

std::optional<Eigen::Isometry3d> poseByPeer(int method, const geometry::Quadrilateral& corners,
                                            const geometry::PinholeCamera& camera,
                                            const geometry::OpeningSize& opening) {
  std::vector<cv::Point2d> image;
  for (const Eigen::Vector2d& corner : corners) image.emplace_back(corner.x(), corner.y());
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  try {
    if (method == kHomography) return byHomography(image, K, distortion, opening);
    const int flag = method == kIppe ? cv::SOLVEPNP_IPPE : cv::SOLVEPNP_ITERATIVE;
    return byPnp(flag, image, K, distortion, opening);
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
}

PoseSurveySetup usualSetup() {
  PoseSurveySetup setup;
  setup.camera = geometry::PinholeCamera::fromFieldOfView(640, 480, 2.0 * std::atan(320.0 / 554.0));
  setup.opening = {1.0, 1.0};
  return setup;
}

double MethodErrors::yawRms() const { return std::sqrt(yaw_squares / std::max(1, count)); }
double MethodErrors::lateralRms() const { return std::sqrt(lateral_squares / std::max(1, count)); }

PoseCellResult surveyCell(const PoseSurveySetup& setup, const PoseCell& cell, int draws, std::uint32_t seed) {
  const estimation::WindowPoseEstimator estimator = estimatorFor(setup);
  Draws source(setup, cell, seed);
  PoseCellResult result;
  result.cell = cell;
  for (int i = 0; i < draws; ++i) {
    const auto view = source.view();
    if (!view) break;
    const auto window = noisyBorders(setup.camera, view->T_camera_window, setup.opening, cell.sample_sigma_px,
                                     source.random());
    const auto bound = poseBound(setup.camera, view->T_camera_window, setup.opening, cell.sample_sigma_px);
    const estimation::GravityPrior gravity{source.disturbed(view->up_camera), setup.attitude_sigma_rad};
    if (!window || !bound) continue;
    ++result.draws;
    addBound(result, *bound);
    const auto alone = estimator.estimate(*window, setup.camera);
    const auto with_attitude = estimator.estimate(*window, setup.camera, {gravity});
    if (alone.estimate) addTrust(result, *view, *alone.estimate);
    const auto poseOf = [](const estimation::PoseResult& found) {
      return found.estimate ? std::optional(found.estimate->best.T_camera_window) : std::nullopt;
    };
    addTo(result.methods[kOurs], *view, poseOf(alone));
    addTo(result.methods[kOursWithAttitude], *view, poseOf(with_attitude));
    for (int peer = kFirstPeer; peer < kPoseMethods; ++peer)
      addTo(result.methods[peer], *view, poseByPeer(peer, window->corners, setup.camera, setup.opening));
  }
  finish(result);
  return result;
}

}  // namespace window_ingress::evaluation
