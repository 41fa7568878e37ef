#include "estimation/checks/mounting_check.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kLastingSec = 10000.0;                    // a mounting does not change
constexpr double kPriorSigmaRad = 0.35;                    // of the camera's attitude before anything is seen
constexpr double kMaxTurnRad = 0.07, kMaxSizeError = 0.1;  // more is a fault; the latter relative
constexpr double kHeadingSigmaRad = 0.03;  // of odometry's heading against its positions: a compass
constexpr double kFaultSigmas = 2.0;       // certainty that the mounting is turned
constexpr double kCertainSigmas = 2.5;     // certainty that it is not, and of a wrong size
constexpr double kImageSpacingM = 0.05;    // images closer together are skipped
constexpr double kSpacingSec = 0.5, kGoodSpacingFactor = 3.0;
constexpr std::size_t kMaxImages = 16, kEnoughImages = 10;
constexpr double kKeptSpacingM = 0.1;
constexpr int kRefusedUntilRestart = 5, kMinUpdates = 15;
constexpr double kOpenScaleSigma = 0.5, kOpenAspectSigma = 0.2;
constexpr double kMeasuredSigma = 0.2;  // a less certain size is not reported
constexpr double kMaxMisfit = 2.0, kOtherMountingBetter = 0.3;
constexpr double kUnexplained = 100.0, kMaxRefusedToTry = 0.3;
constexpr int kSetupsAnImage = 4;

FilterParams openParams(FilterParams filter) {
  filter.attitude_bias_sigma_rad = filter.mounting_yaw_sigma_rad = kPriorSigmaRad;
  filter.attitude_bias_time_sec = kLastingSec;
  filter.heading_bias_sigma_rad = kHeadingSigmaRad;
  filter.yaw_bias_lasts = false;
  filter.trusted_yaw_sigma_rad = 0.5;
  filter.outliers_until_restart = 1000;
  return filter;
}

/// A turn of the camera about the body's axes, with lower and upper bound for the axis furthest off.
struct BodyTurn {
  Eigen::Vector3d roll_pitch_yaw_rad;
  double least_rad, most_rad;
  double least_with_heading_rad;  ///< lower bound for yaw and odometry's heading together
};

BodyTurn bodyTurn(const CameraTurn& camera) {
  const Eigen::Vector3d turn(camera.turn_rad.z(), -camera.turn_rad.x(), -camera.turn_rad.y());
  const Eigen::Vector3d variance = camera.covariance.diagonal();
  const Eigen::Vector3d sigma = Eigen::Vector3d(variance.z(), variance.x(), variance.y()).cwiseSqrt();
  return {turn, (turn.cwiseAbs() - kFaultSigmas * sigma).maxCoeff(),
          (turn.cwiseAbs() + kCertainSigmas * sigma).maxCoeff(),
          std::abs(camera.with_heading_rad) - kFaultSigmas * camera.with_heading_sigma_rad};
}

std::string turnText(const Eigen::Vector3d& roll_pitch_yaw_rad) {
  static const char* const kAxes[] = {"roll", "pitch", "yaw"};
  std::string text;
  const double largest = roll_pitch_yaw_rad.cwiseAbs().maxCoeff();
  for (int axis : {2, 1, 0}) {
    if (std::abs(roll_pitch_yaw_rad(axis)) < 0.5 * largest) continue;
    text += formatted("%s%.0f deg in %s", text.empty() ? "" : " and ",
                      geometry::kDegreesPerRad * roll_pitch_yaw_rad(axis), kAxes[axis]);
  }
  return "camera mounting turned by about " + text;
}

}  // namespace

struct MountingCheck::Setup {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  bool exchanged = false;  // swaps x and y of the position

  Eigen::Isometry3d T_odom_camera(const Image& image) const {
    Eigen::Isometry3d T_odom_base = image.T_odom_base;
    if (exchanged) std::swap(T_odom_base.translation().x(), T_odom_base.translation().y());
    Eigen::Isometry3d T = T_odom_base * image.T_base_camera;
    T.linear() = T.linear() * turn;
    return T;
  }

  std::string text(const Eigen::Matrix3d& R_base_camera) const {
    if (exchanged) return "x and y of odometry's position look exchanged";
    if (turn.isApprox(geometry::R_optical_flu().transpose(), 0.2))
      return "camera frame looks like body axes (x forward), not optical ones (z forward)";
    const auto euler = geometry::eulerFromRotation(R_base_camera * turn * R_base_camera.transpose());
    return turnText({euler.roll_rad, euler.pitch_rad, euler.yaw_rad});
  }
};

struct MountingCheck::Trial {
  double misfit_as_said;
  Setup best;
  double misfit;
  std::vector<Setup> left;
};

// Exchanged axes, and all turns by right angles.
std::vector<MountingCheck::Setup> MountingCheck::setups() {
  std::vector<Setup> all{{Eigen::Matrix3d::Identity(), true}};
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y) {
      Eigen::Matrix3d turn;
      turn.col(0) = (x % 2 == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(x / 2);
      turn.col(1) = (y % 2 == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(y / 2);
      turn.col(2) = turn.col(0).cross(turn.col(1));
      if (x / 2 != y / 2 && !turn.isIdentity()) all.push_back({turn, false});
    }
  return all;
}

MountingCheck::MountingCheck(const PoseParams& pose, const FilterParams& filter, const SizeEstimate& size)
    : estimator_(pose),
      filter_params_(openParams(filter)),
      said_(size),
      open_(sizeEstimate(size.size, kOpenScaleSigma, kOpenAspectSigma)),
      filter_(filter_params_, open_) {}

void MountingCheck::forgetPlaces() {
  filter_.forgetPlaces();
  images_.clear();
  last_.reset();
  refused_ = 0;
  trial_.reset();
}

void MountingCheck::clear() {
  forgetPlaces();
  filter_.reset();
  measured_size_.reset();
  size_is_fault_ = false;
  verdict_ = {FramesVerdict::kUndecided, kNothingYet};
}

// Measurements of one window do not hold for another; findings about the mounting do.
void MountingCheck::startAnewForAnotherTarget(std::uint32_t seen_id) {
  if (seen_id == 0) return;
  if (target_id_ != 0 && seen_id != target_id_) {
    forgetPlaces();
    filter_.reset();
    measured_size_.reset();
    if (size_is_fault_) verdict_ = {FramesVerdict::kUndecided, kNothingYet};
    size_is_fault_ = false;
  }
  target_id_ = seen_id;
}

bool MountingCheck::isFarFromLast(const Image& image) const {
  if (!last_) return true;
  const double spacing_m =
      kImageSpacingM * (verdict_.state == FramesVerdict::kGood ? kGoodSpacingFactor : 1.0);
  const double elapsed_sec = image.window.stamp_sec - last_->stamp_sec;
  return elapsed_sec < 0.0 || elapsed_sec > kSpacingSec ||
         (image.T_odom_base.translation() - last_->position_m).norm() >= spacing_m;
}

void MountingCheck::see(const detection::WindowObservation& window, const geometry::PinholeCamera& camera,
                        const Eigen::Isometry3d& T_odom_base, const Eigen::Isometry3d& T_base_camera,
                        const CameraMotion& motion) {
  if (!geometry::isValidPose(T_odom_base) || !geometry::isValidPose(T_base_camera)) return;
  if (!window.whole() && !filter_.state(window.stamp_sec)) return;
  startAnewForAnotherTarget(window.target_id);
  const Image image{window, camera, T_odom_base, T_base_camera, motion};
  if (!isFarFromLast(image)) return;
  if (window.whole()) keep(image);
  last_ = Place{window.stamp_sec, T_odom_base.translation()};
  if (feed(filter_, image, T_odom_base * T_base_camera)) {
    refused_ = 0;
    return judge();
  }
  if (++refused_ % kRefusedUntilRestart == 0) filter_.forgetPlaces();
  if (trial_ || refused_ >= kRefusedUntilRestart) tryNextSetups();
}

// Always keeps the last image; earlier ones are thinned out.
void MountingCheck::keep(const Image& image) {
  if (images_.size() > 1) {
    const Image& last = images_[images_.size() - 2];
    if ((images_.back().T_odom_base.translation() - last.T_odom_base.translation()).norm() < kKeptSpacingM)
      images_.pop_back();
  }
  images_.push_back(image);
  if (images_.size() > kMaxImages) images_.pop_front();
}

bool MountingCheck::feed(WindowFilter& filter, const Image& image,
                         const Eigen::Isometry3d& T_odom_camera) const {
  std::optional<WindowPoseEstimate> start;
  if (!filter.state(image.window.stamp_sec)) {
    start = estimator_.estimate(image.window, image.camera, {std::nullopt, open_}).estimate;
    if (!start) return false;
  }
  return filter.update(start, image.window, image.camera, T_odom_camera, image.motion);
}

void MountingCheck::judge() {
  const auto found = filter_.state(last_->stamp_sec);
  if (!found || found->updates < kMinUpdates) return;
  trial_.reset();
  if (found->size.log_covariance(1, 1) < kMeasuredSigma * kMeasuredSigma) measured_size_ = found->size;
  judgeTurn(*found);
}

// Both planar hypotheses must agree, because a turned camera and a turned window look alike for a while.
void MountingCheck::judgeTurn(const FilteredWindow& found) {
  BodyTurn turn = bodyTurn(found.camera_turn);
  if (found.alternative) {
    const BodyTurn other = bodyTurn(found.alternative->camera_turn);
    turn.least_rad = std::min(turn.least_rad, other.least_rad);
    turn.most_rad = std::max(turn.most_rad, other.most_rad);
    turn.least_with_heading_rad = std::min(turn.least_with_heading_rad, other.least_with_heading_rad);
  }
  const std::string size_fault = faultOfSize(found.size);
  const FramesVerdict before = verdict_;
  if (turn.least_rad > kMaxTurnRad)
    verdict_ = {FramesVerdict::kWrong, turnText(turn.roll_pitch_yaw_rad)};
  else if (turn.least_with_heading_rad > kMaxTurnWithHeadingRad)
    verdict_ = {FramesVerdict::kWrong,
                formatted("camera mounting or odometry's heading turned by about %.0f deg in yaw",
                          -geometry::kDegreesPerRad * found.camera_turn.with_heading_rad)};
  else if (!size_fault.empty())
    verdict_ = {FramesVerdict::kWrong, size_fault};
  else if (turn.most_rad < 2.0 * kMaxTurnRad)
    verdict_ = {FramesVerdict::kGood, ""};
  else if (verdict_.state != FramesVerdict::kWrong)
    verdict_ = {FramesVerdict::kUndecided,
                formatted("camera mounting: a turn of %.0f deg cannot be excluded yet",
                          geometry::kDegreesPerRad * turn.most_rad)};
  if (!(verdict_ == before)) size_is_fault_ = verdict_.what == size_fault && !size_fault.empty();
}

// Empty if the size is as stated, or was not stated as known.
std::string MountingCheck::faultOfSize(const SizeEstimate& found) const {
  if (!said_.log_covariance.isZero(0.0)) return "";
  const Eigen::Vector2d grown(std::log(found.size.width_m / said_.size.width_m),
                              std::log(found.size.height_m / said_.size.height_m));
  const Eigen::Vector2d sigma = found.log_covariance.diagonal().cwiseSqrt();
  const double least = (grown.cwiseAbs() - kCertainSigmas * sigma).maxCoeff();
  if (!(least > kMaxSizeError)) return "";
  return formatted("opening looks like %.2f x %.2f m, configured as %.2f x %.2f m", found.size.width_m,
                   found.size.height_m, said_.size.width_m, said_.size.height_m);
}

// Mean of the images' normalised squares; each image that does not fit counts as kUnexplained.
double MountingCheck::misfitOf(const Setup& setup) const {
  WindowFilter filter(filter_params_, open_);
  const double images = static_cast<double>(images_.size());
  int refused = 0;
  for (const Image& image : images_) {
    refused += !feed(filter, image, setup.T_odom_camera(image));
    if (refused > kMaxRefusedToTry * images) return kUnexplained;
  }
  const auto found = filter.state(images_.back().window.stamp_sec);
  return found ? found->consistency.mean_nis + kUnexplained * refused / images : kUnexplained;
}

void MountingCheck::tryNextSetups() {
  if (images_.size() < kEnoughImages) return;
  if (!trial_) trial_ = std::make_shared<Trial>(Trial{misfitOf(Setup{}), {}, kUnexplained, setups()});
  for (int i = 0; i < kSetupsAnImage && !trial_->left.empty(); ++i) {
    const Setup setup = trial_->left.back();
    trial_->left.pop_back();
    const double misfit = misfitOf(setup);
    if (misfit >= trial_->misfit) continue;
    trial_->best = setup;
    trial_->misfit = misfit;
  }
  if (!trial_->left.empty()) return;
  if (trial_->misfit < kMaxMisfit && trial_->misfit < kOtherMountingBetter * trial_->misfit_as_said)
    verdict_ = {FramesVerdict::kWrong, trial_->best.text(images_.back().T_base_camera.linear())};
  trial_.reset();
}

}  // namespace window_ingress::estimation
