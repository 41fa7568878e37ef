#include "window_ingress/estimation/target_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimation/checks/flight_checks.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kSureMountingRad = 0.001;  ///< a mounting stated to be more certain is not checked [rad]

SizeEstimate sizeSaid(const PoseParams& pose) {
  return sizeEstimate({pose.opening_width_m, pose.opening_height_m}, pose.scale_sigma, pose.aspect_sigma);
}

}  // namespace

TargetEstimator::TargetEstimator(const PoseParams& pose, const FilterParams& filter,
                                 const TargetEstimatorParams& params)
    : params_(parameters::requireInRange(params, "tracker")),
      estimator_(pose),
      filter_(filter, sizeSaid(pose)),
      checks_(new FlightChecks{MountingCheck(pose, filter, sizeSaid(pose)),
                               ParallaxCheck(filter.target_speed_mps)}),
      judge_(params.openness, params.needed),
      facade_(params.facade),
      size_is_known_(sizeSaid(pose).log_covariance.isZero(0.0)),
      mounting_is_sure_(filter.mounting_yaw_sigma_rad <= kSureMountingRad),
      attitude_sigma_rad_(filter.attitude_bias_sigma_rad) {}

TargetEstimator::~TargetEstimator() = default;
TargetEstimator::TargetEstimator(TargetEstimator&&) noexcept = default;
TargetEstimator& TargetEstimator::operator=(TargetEstimator&&) noexcept = default;

void TargetEstimator::forgetPlaces() {
  filter_.forgetPlaces();
  checks_->forgetPlaces();
  clocks_.forgetPlaces();
  judge_.reset();
  facade_.forgetPlaces();
  odometry_.clear();
  attitude_.clear();
  odometry_stamp_sec_.reset();
  pending_.reset();
  unverified_.clear();
  last_ = TargetUpdate();
}

void TargetEstimator::reset() {
  forgetPlaces();
  filter_.reset();
  checks_->clear();
  clocks_.clear();
  facade_.reset();
}

void TargetEstimator::addOdometry(double stamp_sec, const Eigen::Isometry3d& T_odom_base,
                                  const std::optional<Eigen::Vector3d>& velocity_odom_mps,
                                  const Eigen::Vector3d& turn_odom_radps) {
  if (!geometry::isValidPose(T_odom_base) || !std::isfinite(stamp_sec)) return;
  if (odometry_stamp_sec_) {
    const double dt_sec = stamp_sec - *odometry_stamp_sec_;
    if (dt_sec < 0.0 && dt_sec > -PoseBuffer::kLateSec) return;
    if (dt_sec < 0.0) reset();
    if (dt_sec >= 0.0 && isJump(dt_sec, T_odom_base)) forgetPlaces();
  }
  if (!odometry_.add(stamp_sec, T_odom_base)) return;
  if (velocity_odom_mps) checks_->twist.add(stamp_sec, T_odom_base, *velocity_odom_mps);
  odometry_stamp_sec_ = stamp_sec;
  last_T_odom_base_ = T_odom_base;
  // Uses only the heading rate: tilt changes within the delay, so tilt rates say nothing about the delay.
  motion_ = {velocity_odom_mps.value_or(Eigen::Vector3d::Zero()), {0.0, 0.0, turn_odom_radps.z()}};
  if (!motion_.velocity_mps.allFinite() || !motion_.turn_radps.allFinite()) motion_ = {};
  if (pending_ && pending_->stamp_sec <= stamp_sec) flush();
  verifyMounting(stamp_sec);
}

// Detects a jump of the odom frame, after which all places in it are invalid. The filter's outlier rejection
// and restarts handle smaller jumps. The navigator must know the vehicle's path to centimetres and uses lower
// limits (`ContinuousOdometry`).
bool TargetEstimator::isJump(double dt_sec, const Eigen::Isometry3d& T_odom_base) const {
  constexpr double kMaxJumpM = 0.5, kMaxTurnJumpRad = 0.35, kFastestMps = 3.0, kFastestRadps = 3.0;
  const double moved_m = (T_odom_base.translation() - last_T_odom_base_.translation()).norm();
  const Eigen::Quaterniond before(last_T_odom_base_.linear()), now(T_odom_base.linear());
  return moved_m > kMaxJumpM + kFastestMps * dt_sec ||
         before.angularDistance(now) > kMaxTurnJumpRad + kFastestRadps * dt_sec;
}

void TargetEstimator::addAttitude(double stamp_sec, const Eigen::Quaterniond& R_odom_base) {
  attitude_.add(stamp_sec, geometry::makePose(R_odom_base.toRotationMatrix(), Eigen::Vector3d::Zero()));
}

void TargetEstimator::addDetection(const detection::WindowObservation& window,
                                   const geometry::PinholeCamera& camera,
                                   const std::optional<Eigen::Isometry3d>& T_base_camera) {
  addDetection({window.stamp_sec, camera, T_base_camera, window, {}});
}

void TargetEstimator::addDetection(ObservedImage image) {
  flush();
  pending_ = std::move(image);
  if (odometry_stamp_sec_ && *odometry_stamp_sec_ >= pending_->stamp_sec) flush();
}

void TargetEstimator::flush() {
  if (pending_) process(*pending_);
  pending_.reset();
}

std::optional<Eigen::Isometry3d> TargetEstimator::cameraAt(
    double stamp_sec, const std::optional<Eigen::Isometry3d>& T_base_camera) const {
  const auto T_odom_base = odometry_.at(stamp_sec, kMaxPoseGapSec);
  if (!T_odom_base || !T_base_camera) return std::nullopt;
  return *T_odom_base * *T_base_camera;
}

// Findings about the size hold for one window only.
void TargetEstimator::noticeTarget(std::uint32_t target_id) {
  if (target_id == target_id_) return;
  target_id_ = target_id;
  checks_->parallax.clear();
  unverified_.clear();
  checks_->mounting.startAnewForAnotherTarget(target_id);
  clocks_.forgetPlaces();
}

void TargetEstimator::process(const ObservedImage& image) {
  const auto T_odom_camera = cameraAt(image.stamp_sec, image.T_base_camera);
  std::optional<FilteredWindow> used;
  if (image.window) {
    noticeTarget(image.window->target_id);
    last_.pose =
        estimator_.estimate(*image.window, image.camera, {gravity(image), filter_.sizeOf(*image.window)});
    last_.why_not = updateFilter(image, T_odom_camera);
    const auto window = filter_.state(image.stamp_sec);
    if (last_.why_not.empty()) used = window;
    if (used) judgeOpenness(image, *T_odom_camera, *used);
    if (window && T_odom_camera) checkClocks(image, *T_odom_camera, *window);
  }
  if (T_odom_camera) rememberWindows(image, *T_odom_camera, used);
}

void TargetEstimator::rememberWindows(const ObservedImage& image, const Eigen::Isometry3d& T_odom_camera,
                                      const std::optional<FilteredWindow>& used) {
  std::optional<facade::TrackedWindow> tracked;
  if (used)
    tracked = facade::TrackedWindow{used->T_odom_window, used->covariance, used->size.size,
                                    used->sign_trusted, used->updates};
  facade_.addView({image.stamp_sec,
                   {image.camera, T_odom_camera},
                   image.windows,
                   image.window ? image.window->target_id : 0},
                  tracked, used ? used->size.size : lookedFor());
  if (used) facade_.judge(openness());
}

geometry::OpeningSize TargetEstimator::lookedFor() const {
  const auto& pose = estimator_.params();
  return {pose.opening_width_m, pose.opening_height_m};
}

std::optional<geometry::Quadrilateral> TargetEstimator::expected(
    double stamp_sec, const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera) const {
  const auto T_odom_camera = cameraAt(stamp_sec, T_base_camera);
  return T_odom_camera ? facade_.expected({camera, *T_odom_camera}) : std::nullopt;
}

// Forgets the findings about the previous target.
void TargetEstimator::startAnewIfNot(std::uint32_t target_before) {
  if (facade_.targetId() == target_before) return;
  filter_.reset();
  checks_->parallax.clear();
  judge_.reset();
}

Reply TargetEstimator::selectWindow(std::uint32_t id) {
  const std::uint32_t before = facade_.targetId();
  const Reply reply = facade_.select(id);
  startAnewIfNot(before);
  return reply;
}

Reply TargetEstimator::selectWindowNear(const Eigen::Vector3d& point_odom_m) {
  const std::uint32_t before = facade_.targetId();
  const Reply reply = facade_.selectNear(point_odom_m);
  startAnewIfNot(before);
  return reply;
}

void TargetEstimator::addNavigatorState(std::uint32_t flown_at, const std::vector<std::uint32_t>& given_up,
                                        bool next_one) {
  facade_.noteFlownAt(flown_at);
  // Windows have new numbers after a start of this node or `reset`; fewer windows: another mission began.
  const std::size_t handled = std::min(handled_given_up_.value_or(given_up.size()), given_up.size());
  const std::vector<std::uint32_t> news(given_up.begin() + static_cast<std::ptrdiff_t>(handled),
                                        given_up.end());
  handled_given_up_ = given_up.size();
  if (news.empty()) return;
  const std::uint32_t before = facade_.targetId();
  facade_.giveUp(news, next_one);
  if (next_one) startAnewIfNot(before);
}

std::string TargetEstimator::updateFilter(const ObservedImage& image,
                                          const std::optional<Eigen::Isometry3d>& T_odom_camera) {
  const detection::WindowObservation& window = *image.window;
  const int sides = window.visibleSides();  // 0: only corners are known
  const bool is_whole = window.whole() && (sides == 4 || sides == 0);
  if (T_odom_camera)
    if (auto other = facade_.whyNotTarget(window, {image.camera, *T_odom_camera}, lookedFor());
        !other.empty())
      return other;
  // Keeps images without a pose, too, because a wrongly mounted camera may give none.
  if (T_odom_camera && !mounting_is_sure_) unverified_.push_back(image);
  if (!last_.pose.estimate && is_whole) return last_.pose.detail;
  if (!image.T_base_camera) return "mounting of the camera unknown";
  if (!T_odom_camera) return "no odometry near the exposure";
  checkSize(image, *T_odom_camera);
  if (filter_.update(last_.pose.estimate, window, image.camera, *T_odom_camera, motion_)) return "";
  const auto [width_m, height_m] = lookedFor();
  return formatted(
      "gated out: does not fit earlier images, an opening of %.2f x %.2f m or the camera's angles", width_m,
      height_m);
}

// By the attitude of the IMU, unless there is none or it uses other axes.
std::optional<GravityPrior> TargetEstimator::gravity(const ObservedImage& image) {
  if (!image.T_base_camera) return std::nullopt;
  const auto imu = attitude_.at(image.stamp_sec, kMaxPoseGapSec);
  const auto odometry = odometry_.at(image.stamp_sec, kMaxPoseGapSec);
  const bool agree = !imu || !odometry || checks_->attitude.see(imu->linear(), odometry->linear());
  const auto& T_odom_base = imu && agree ? imu : odometry;
  if (!T_odom_base) return std::nullopt;
  const Eigen::Matrix3d R_odom_camera = T_odom_base->linear() * image.T_base_camera->linear();
  return GravityPrior{R_odom_camera.transpose() * Eigen::Vector3d::UnitZ(), attitude_sigma_rad_};
}

std::optional<TargetEstimate> TargetEstimator::target(double now_sec) const {
  const auto window = filter_.state(now_sec);
  if (!window) return std::nullopt;
  TargetEstimate target;
  target.stamp_sec = window->stamp_sec;
  target.T_odom_window = window->T_odom_window;
  target.covariance = window->covariance;
  target.sign_trusted = window->sign_trusted;
  target.motion = window->motion;
  target.pose_stamp_sec = window->stamp_sec + window->age_sec;
  target.opening = window->size.size;
  target.fit = fit(*window).fit;
  target.approach_forbidden = approachForbidden(*window);
  target.unverified = unverified();
  target.other_window = otherWindow();
  target.openness = openness();
  target.window_id = facade_.targetId();
  return target;
}

}  // namespace window_ingress::estimation
