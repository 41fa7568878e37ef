#include "evaluation/flights/closed_loop_flight.hpp"

#include <cmath>

#include "evaluation/flights/flight_perception.hpp"
#include "evaluation/flights/projected_detector.hpp"
#include "evaluation/flights/told_sizes.hpp"
#include "simulation/camera/reference_image.hpp"
#include "window_ingress/configuration/pose_node_params.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/navigation/navigator.hpp"

namespace window_ingress::evaluation {
namespace {

using navigation::State;
using simulation::Claim;
using simulation::Outcome;
using Images = simulation::World::Images;

constexpr double kTrackPeriod_sec = 0.1;

/// The parameters, completed by what is known of the vehicle and its target before the flight.
FlightParams withFactsOf(const simulation::World& world, FlightParams params) {
  const auto tell = [&](const char* key, auto& value, const auto& fact) {
    if (!params.gives(key)) value = fact;
  };
  const simulation::Scenario& scenario = world.scenario();
  navigation::VehicleParams& vehicle = params.ingress_navigator.navigator.vehicle;
  tellSizes(scenario, params, vehicle, params.homography_pose.pose);
  const auto camera = world.camera();  // the nodes take what follows from camera_info and tf
  tell("vehicle/camera_forward_m", vehicle.camera.forward_m, world.T_base_camera().translation().x());
  tell("vehicle/horizontal_fov_rad", vehicle.camera.horizontal_fov_rad,
       2.0 * std::atan(camera.width / (2.0 * camera.fx)));
  tell("vehicle/vertical_fov_rad", vehicle.camera.vertical_fov_rad,
       2.0 * std::atan(camera.height / (2.0 * camera.fy)));
  tell("vehicle/pixel_rad", vehicle.camera.pixel_rad, 1.0 / camera.fx);
  tell("vehicle/exposure_sec", vehicle.exposure_sec, scenario.camera.exposure_sec);
  params.homography_pose.tracker.needed = configuration::neededBy(vehicle);
  navigation::CommitParams& commit = params.ingress_navigator.navigator.commit;
  if (scenario.glass != "as_set")  // the scenario's policy: there is no operator to ask
    tell("ingress_navigator/navigator/commit/glass", commit.glass, scenario.glass);
  if (scenario.unverified_opening != "as_set")
    tell("ingress_navigator/navigator/commit/unverified_opening", commit.unverified_opening,
         scenario.unverified_opening);
  if (params.without_images)  // no image shows it
    commit.glass = "excluded", commit.unverified_opening = "allow";
  return params;
}

const simulation::Scenario& flyable(const simulation::Scenario& scenario) {
  if (scenario.vehicle.profile != "external") return scenario;
  throw InputError(
      "vehicle: external is flown elsewhere, over ROS topics; take another profile, or the world node");
}

Claim claimOf(State state) {
  if (state == State::kPassed) return Claim::kPassed;
  return state == State::kAborted ? Claim::kAborted : Claim::kNone;
}

class Flight {
 public:
  Flight(const simulation::Scenario& scenario, std::uint32_t seed, const FlightParams& params,
         const std::vector<FlightObserver*>& observers)
      : observers_(observers),
        world_(flyable(scenario), seed, params.without_images ? Images::kNone : Images::kDrawn),
        params_(withFactsOf(world_, params)),
        perception_(params_),
        sight_(seed),
        navigator_(params_.ingress_navigator.navigator) {
    if (!params_.without_images) showReference();
    timing_.lap(Stage::kOther);
  }

  simulation::Verdict fly() {
    double next_step_sec = 0.0;
    for (auto* observer : observers_) observer->onStart(world_);
    auto verdict = world_.referee().judge(Claim::kNone);
    while (verdict.outcome == Outcome::kRunning) {
      world_.advance();
      timing_.lap(Stage::kPhysics);
      sense();
      if (world_.timeSec() < next_step_sec) continue;
      next_step_sec += 1.0 / params_.ingress_navigator.rate_hz;
      step();
      timing_.lap(Stage::kNavigator);
      keepTrack();
      if (!observers_.empty()) report();
      verdict = world_.referee().judge(claimOf(output_.state), started_sec_.value_or(0.0));
      timing_.lap(Stage::kOther);
    }
    for (auto* observer : observers_) observer->onEnd();
    timing_.addSimulated(world_.timeSec());
    return verdict;
  }

  FlightResult result(std::uint32_t seed, const simulation::Verdict& verdict) const {
    const auto& referee = world_.referee();
    FlightResult result;
    result.seed = seed;
    result.outcome = verdict.outcome;
    result.track = track_;
    const double end_sec = referee.crossing() ? referee.crossing()->time_sec : world_.timeSec();
    result.time_sec = end_sec - started_sec_.value_or(0.0);
    if (referee.crossing()) {
      result.offset_y_m = referee.crossing()->offset_y_m;
      result.offset_z_m = referee.crossing()->offset_z_m;
    }
    result.min_clearance_m = referee.minClearance();
    result.wrong_side_m = referee.wrongSide();
    result.max_speed_mps = referee.maxSpeed();
    result.nearest_m = referee.nearest();
    result.blind_sec = output_.report.blind_sec;
    result.clock_offset = estimator().clockOffset();
    result.forbidden = forbidden_;
    if (output_.report.predicted_miss_m > 0.0) result.predicted_miss_m = output_.report.predicted_miss_m;
    result.reason = verdict.outcome == Outcome::kPassed
                        ? verdict.reason
                        : verdict.reason + " [" + toString(output_.state) + ": " +
                              (refusal_.empty() ? output_.reason : refusal_) + "]";
    return result;
  }

  const FlightTiming& timing() const { return timing_; }

 private:
  estimation::TargetEstimator& estimator() { return perception_.estimator(); }
  const estimation::TargetEstimator& estimator() const { return perception_.estimator(); }

  void sense() {
    while (const auto odometry = world_.takeOdometry()) {
      for (auto* observer : observers_) observer->onOdometry(*odometry);
      navigation::VehicleState vehicle{
          odometry->stamp_sec, odometry->T_odom_base, odometry->velocity_odom_mps,
          odometry->T_odom_base.linear() * odometry->angular_velocity_base_radps};
      vehicle.stamp_sec = perception_.addOdometry(vehicle, world_.timeSec());
      input_.vehicle = vehicle;
    }
    while (const auto imu = world_.takeImu()) {
      for (auto* observer : observers_) observer->onImu(*imu);
      perception_.addAttitude(imu->stamp_sec, imu->R_odom_base);
    }
    while (const auto calibration = world_.takeCalibration()) {
      for (auto* observer : observers_) observer->onCalibration(*calibration);
      perception_.calibrate(calibration->camera);
    }
    if (const auto frame = world_.takeFrame()) look(*frame);
  }

  void showReference() {
    geometry::Quadrilateral corners;
    const cv::Mat image = simulation::referenceImage(world_.scenario(), &corners);
    perception_.setReference(detection::ReferenceAppearance(image, corners));
  }

  std::optional<detection::WindowObservation> detect(const simulation::CameraFrame& frame) {
    if (params_.without_images && !world_.scenario().window.present) return std::nullopt;
    if (params_.without_images)
      return sight_.look(world_.camera(), frame.T_camera_window, world_.opening(), frame.stamp_sec);
    return perception_.detect(frame.image, frame.stamp_sec, world_.T_base_camera());
  }

  void look(const simulation::CameraFrame& frame) {
    timing_.lap(Stage::kImage);
    timing_.countFrame();
    const auto window = detect(frame);
    timing_.lap(Stage::kDetector);
    detected_ = window.has_value();
    input_.image_stamp_sec = frame.stamp_sec;
    if (!frame.image.empty())
      for (auto* observer : observers_) observer->onImage(frame, perception_.perception().trace(), window);
    timing_.lap(Stage::kOther);
    perception_.addDetection(frame.stamp_sec, world_.T_base_camera(), window);
    timing_.lap(Stage::kPose);
  }

  // Acts as the scenario's operator: selects the target as soon as it is in the memory of all windows, then
  // starts the mission. Without images only the target is seen.
  void chooseTarget() {
    was_chosen_ = was_chosen_ || !world_.scenario().target_chosen || params_.without_images;
    if (was_chosen_) return;
    const Eigen::Isometry3d T_odom_window = world_.odometryDrift() * world_.T_odom_window();
    was_chosen_ = estimator().selectWindowNear(T_odom_window.translation()).success;
  }

  void step() {
    const double now_sec = world_.timeSec();
    chooseTarget();
    input_.target = estimator().target(now_sec);
    noteWhatForbids();
    const facade::KnownWindow* remembered = estimator().facade().target();
    input_.remembered_odom_m = remembered ? std::optional(remembered->place.position_m) : std::nullopt;
    if (!started_sec_ && input_.image_stamp_sec && was_chosen_) {
      const Reply reply = navigator_.start(input_, now_sec);
      if (reply.success) started_sec_ = now_sec;
      refusal_ = reply.success ? "" : "not started: " + reply.message;
    }
    // A dead guard passes nothing on; once the navigator knows, its own zeros reach the vehicle.
    const simulation::FaultParams* dead_guard = world_.acting("guard");
    const double silent_sec = dead_guard ? now_sec - dead_guard->at_sec : 0.0;
    input_.passed_on = silent_sec <= params_.ingress_navigator.guard.max_silence_sec;
    output_ = navigator_.step(input_, now_sec);
    estimator().addNavigatorState(output_.report.window_id, output_.report.given_up,
                                  output_.report.next_window);
    if (!output_.enabled || (dead_guard && input_.passed_on)) return;
    if (dead_guard) return world_.command({});
    world_.command({output_.setpoint.velocity_odom_mps, output_.setpoint.yaw_rate_radps});
  }

  void noteWhatForbids() {
    if (!forbidden_.empty()) return;
    const estimation::FramesVerdict frames = estimator().frames();
    const bool is_wrong = frames.state == estimation::FramesVerdict::kWrong;
    if (is_wrong || input_.target) forbidden_ = is_wrong ? frames.what : input_.target->approach_forbidden;
  }

  void keepTrack() {
    const double time_sec = world_.timeSec() - started_sec_.value_or(world_.timeSec());
    if (!track_.empty() && time_sec - track_.back().time_sec < kTrackPeriod_sec) return;
    track_.push_back({time_sec, world_.T_odom_window().inverse() * world_.truth().T_odom_base.translation()});
  }

  void report() const {
    const FlightRecord now = record();
    for (auto* observer : observers_) observer->onStep(now, output_);
  }

  FlightRecord record() const {
    const Eigen::Matrix3d R_window_odom = world_.T_odom_window().linear().transpose();
    const auto& truth = world_.truth();
    FlightRecord record;
    record.time_sec = world_.timeSec() - started_sec_.value_or(world_.timeSec());
    record.state = output_.state;
    record.reason = output_.reason;
    record.position_m = world_.T_odom_window().inverse() * truth.T_odom_base.translation();
    record.heading_rad = geometry::yawOf(R_window_odom * truth.T_odom_base.linear());
    record.velocity_mps = R_window_odom * truth.velocity_odom_mps;
    record.setpoint_mps =
        R_window_odom * (world_.odometryDrift().linear().transpose() * output_.setpoint.velocity_odom_mps);
    record.setpoint_yaw_rate_radps = output_.setpoint.yaw_rate_radps;
    record.detected = detected_;
    record.sighting = estimator().lastUpdate().why_not;
    record.predicted_miss_m = output_.report.predicted_miss_m;
    recordTarget(record);
    recordImage(record);
    return record;
  }

  void recordTarget(FlightRecord& record) const {
    if (!input_.target) return;
    const auto& target = *input_.target;
    const Eigen::Isometry3d T_window_estimate =
        world_.T_odom_window().inverse() * world_.odometryDrift().inverse() * target.T_odom_window;
    const Eigen::Vector3d left = target.T_odom_window.linear().col(1);
    record.has_target = true;
    record.sign_trusted = target.sign_trusted;
    record.target_age_sec = world_.timeSec() - target.stamp_sec;
    record.target_error_m = T_window_estimate.translation();
    record.target_yaw_error_rad = geometry::yawOf(T_window_estimate.linear());
    record.target_sigma_m = std::sqrt(left.dot(target.covariance.topLeftCorner<3, 3>() * left));
    record.target_yaw_sigma_rad = std::sqrt(target.covariance(5, 5));
  }

  void recordImage(FlightRecord& record) const {
    const auto& seen = estimator().lastUpdate().pose.estimate;
    if (!seen || !started_sec_) return;
    record.image = ImageRecord{
        seen->stamp_sec - *started_sec_, seen->yaw_rad,      seen->sign_trusted, seen->opening_width_m,
        seen->opening_height_m,          seen->left_side_px, seen->right_side_px};
  }

  std::vector<FlightObserver*> observers_;
  simulation::World world_;
  FlightParams params_;
  FlightPerception perception_;
  ProjectedDetector sight_;
  navigation::Navigator navigator_;
  navigation::NavigatorInput input_;
  navigation::NavigatorOutput output_;
  std::optional<double> started_sec_;
  std::string refusal_;    // of the start
  std::string forbidden_;  // the first reason
  bool detected_ = false, was_chosen_ = false;
  std::vector<TrackPoint> track_;
  FlightTiming timing_;
};

}  // namespace

FlightResult flyOnce(const simulation::Scenario& scenario, std::uint32_t seed, const FlightParams& params,
                     const std::vector<FlightObserver*>& observers, FlightTiming* timing) {
  Flight flight(scenario, seed, params, observers);
  const auto verdict = flight.fly();
  if (timing != nullptr) timing->add(flight.timing());
  return flight.result(seed, verdict);
}

}  // namespace window_ingress::evaluation
