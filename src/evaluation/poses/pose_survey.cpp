#include "evaluation/poses/pose_survey.hpp"

#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "estimation/planar/relative_yaw.hpp"
#include "evaluation/csv.hpp"
#include "evaluation/statistics.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::kDegreesPerRad;

std::vector<cv::Point3d> planeCorners(const geometry::OpeningSize& opening) {
  const double x = 0.5 * opening.width_m, y = 0.5 * opening.height_m;
  return {{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}};
}

Eigen::Matrix3d eigenOf(const cv::Matx33d& m) { return Eigen::Map<const Eigen::Matrix3d>(m.val).transpose(); }

std::optional<Isometry3d> windowPose(const Eigen::Matrix3d& R_camera_plane, const Vector3d& t) {
  const Isometry3d pose = geometry::makePose(R_camera_plane * geometry::R_optical_flu(), t);
  return geometry::isValidPose(pose) ? std::optional(pose) : std::nullopt;
}

std::optional<Isometry3d> byPnp(int flag, const std::vector<cv::Point2d>& image, const cv::Matx33d& K,
                                const std::vector<double>& distortion, const geometry::OpeningSize& opening) {
  std::vector<cv::Mat> rotations, translations;
  if (cv::solvePnPGeneric(planeCorners(opening), image, K, distortion, rotations, translations, false,
                          static_cast<cv::SolvePnPMethod>(flag)) < 1)
    return std::nullopt;
  cv::Matx33d R;
  cv::Rodrigues(rotations[0], R);
  const cv::Mat& t = translations[0];
  return windowPose(eigenOf(R), {t.at<double>(0), t.at<double>(1), t.at<double>(2)});
}

std::optional<Isometry3d> byHomography(const std::vector<cv::Point2d>& image, const cv::Matx33d& K,
                                       const std::vector<double>& distortion,
                                       const geometry::OpeningSize& opening) {
  std::vector<cv::Point2d> normalised, plane;
  cv::undistortPoints(image, normalised, K, distortion);
  for (const cv::Point3d& corner : planeCorners(opening)) plane.emplace_back(corner.x, corner.y);
  const cv::Mat homography = cv::findHomography(plane, normalised);
  if (homography.empty()) return std::nullopt;
  const Eigen::Matrix3d H = eigenOf(cv::Matx33d(homography.ptr<double>()));
  const double length = 0.5 * (H.col(0).norm() + H.col(1).norm()) * (H(2, 2) < 0.0 ? -1.0 : 1.0);
  const Vector3d r1 = H.col(0) / length, r2 = H.col(1) / length, r3 = r1.cross(r2);
  const cv::Matx33d columns(r1(0), r2(0), r3(0), r1(1), r2(1), r3(1), r1(2), r2(2), r3(2));
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
  ++(pose ? errors.count : errors.failed);
  if (!pose) return;
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

double ratio(const PoseCellResult& result, int method) {
  return result.methods[method].yawRms() / result.yaw_bound_rad;
}

// Ours may exceed the best peer by the random difference of two equal methods.
bool isBestOrEqual(const PoseCellResult& result) {
  double best_peer = std::numeric_limits<double>::infinity();
  for (int method = kFirstPeer; method < kPoseMethods; ++method)
    if (result.methods[method].count > 0) best_peer = std::min(best_peer, ratio(result, method));
  return ratio(result, kOurs) <= best_peer * 1.005;
}

}  // namespace

const char* nameOfMethod(int method) {
  constexpr const char* kNames[kPoseMethods] = {"ours", "ours_attitude", "iterative", "ippe", "homography"};
  return kNames[method];
}

std::optional<Isometry3d> poseByPeer(int method, const geometry::Quadrilateral& corners,
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
    result.yaw_bound_rad += bound->yaw_rad * bound->yaw_rad;
    result.lateral_bound_m += bound->lateral_m * bound->lateral_m;
    result.sigma_u_rad += bound->sigma_u_rad * bound->sigma_u_rad;
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
  for (double* squares : {&result.yaw_bound_rad, &result.lateral_bound_m, &result.sigma_u_rad})
    *squares = std::sqrt(*squares / std::max(1, result.draws));
  result.yaw_consistency /= std::max(1, result.methods[kOurs].count);
  return result;
}

std::string poseSurveyColumns() {
  std::string text =
      "distance_m,yaw_deg,sample_sigma_px,draws,yaw_bound_deg,lateral_bound_m,sigma_u_deg,decidable,trusted,"
      "trusted_wrong,trusted_yaw_rmse_deg,yaw_consistency";
  for (int method = 0; method < kPoseMethods; ++method)
    for (const char* what : {"_yaw_rmse_deg", "_lateral_rmse_m", "_wrong_signs", "_failed"})
      text += std::string(",") + nameOfMethod(method) + what;
  return text;
}

std::string poseSurveyRow(const PoseCellResult& r) {
  const double trusted_yaw_rms = std::sqrt(r.trusted_yaw_squares / std::max(1, r.trusted));
  std::string text = formatted("%g,%g,%g,%d,%.6f,%.6f,%.6f,%d,%d,%d,%.6f,%.4f", r.cell.distance_m,
                               r.cell.yaw_rad * kDegreesPerRad, r.cell.sample_sigma_px, r.draws,
                               r.yaw_bound_rad * kDegreesPerRad, r.lateral_bound_m,
                               r.sigma_u_rad * kDegreesPerRad, r.signIsDecidable(), r.trusted,
                               r.trusted_wrong, trusted_yaw_rms * kDegreesPerRad, r.yaw_consistency);
  for (const MethodErrors& errors : r.methods)
    text += formatted(",%.6f,%.6f,%d,%d", errors.yawRms() * kDegreesPerRad, errors.lateralRms(),
                      errors.wrong_signs, errors.failed);
  return text;
}

std::string poseSurveyTable(const std::vector<PoseCellResult>& results) {
  std::string head = "| distance m | yaw deg | noise px | bound deg | sigma_u deg | trusted % |";
  for (int method = 0; method < kPoseMethods; ++method)
    head += std::string(" ") + nameOfMethod(method) + " |";
  std::string text = markdownHead(head);
  for (const PoseCellResult& r : results) {
    text +=
        formatted("| %g | %g | %g | %.3f | %.3f | %.0f |", r.cell.distance_m, r.cell.yaw_rad * kDegreesPerRad,
                  r.cell.sample_sigma_px, r.yaw_bound_rad * kDegreesPerRad, r.sigma_u_rad * kDegreesPerRad,
                  100.0 * r.trusted / std::max(1, r.draws));
    for (int method = 0; method < kPoseMethods; ++method) text += formatted(" %.2f |", ratio(r, method));
    text += "\n";
  }
  return text;
}

std::string poseSurveySummary(const std::vector<PoseCellResult>& results) {
  int draws = 0, trusted = 0, wrong = 0, decidable = 0, best = 0;
  double worst = 0.0;
  const PoseCellResult* at = nullptr;
  for (const PoseCellResult& r : results) {
    draws += r.draws, trusted += r.trusted, wrong += r.trusted_wrong;
    best += isBestOrEqual(r);
    if (!r.signIsDecidable()) continue;
    ++decidable;
    if (ratio(r, kOurs) > worst) worst = ratio(r, kOurs), at = &r;
  }
  const Interval rate = wilson95(wrong, trusted);
  std::string text = formatted(
      "%d draws, sign trusted in %d, of these wrong %d (%.4f %%, 95 %% interval %.4f to %.4f %%)\n", draws,
      trusted, wrong, 100.0 * wrong / std::max(1, trusted), 100.0 * rate.low, 100.0 * rate.high);
  text += formatted("best or equal (0.5 %%) in %d of %zu cells\n", best, results.size());
  if (at != nullptr)
    text += formatted(
        "largest yaw RMSE / bound %.3f of %d cells with sigma_u < yaw / 3, at %g m, %g deg, %g px\n", worst,
        decidable, at->cell.distance_m, at->cell.yaw_rad * kDegreesPerRad, at->cell.sample_sigma_px);
  return text;
}

}  // namespace window_ingress::evaluation
