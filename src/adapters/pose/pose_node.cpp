#include <nav_msgs/Odometry.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/transform_listener.h>

#include "adapters/inputs/attitude_source.hpp"
#include "adapters/inputs/camera_source.hpp"
#include "adapters/nodes.hpp"
#include "adapters/pose/pose_health.hpp"
#include "adapters/pose/pose_publisher.hpp"
#include "adapters/pose/window_selection.hpp"
#include "adapters/runtime/lockstep.hpp"
#include "adapters/runtime/parameter_server.hpp"
#include "adapters/runtime/services.hpp"
#include "window_ingress/configuration/pose_node_params.hpp"
#include "window_ingress/navigation/empty_twist.hpp"

namespace window_ingress::adapters {
namespace {
constexpr double kPendingPeriodSec = 0.01, kOdometryGoneSec = 0.3;
}

using configuration::PoseNodeParams;

/// Pose estimator and filter between topics: corners and calibration in, the window's pose out.
class PoseNode : public Node {
 public:
  PoseNode(ros::NodeHandle& nh, ros::NodeHandle& pnh)
      : params_(readChecked(nh, pnh)),
        diagnostics_(nh, pnh),
        window_(diagnostics_, "window", limitsFor(params_.lockstep, vehicle_.stamps)),
        odom_(diagnostics_, "odom", limitsFor(params_.lockstep, vehicle_.stamps)),
        camera_(nh, diagnostics_, vehicle_.image_is_rectified),
        estimator_(params_.pose, params_.filter, params_.tracker),
        T_base_camera_{std::nullopt, "no image so far"},
        tf_listener_(tf_),
        selection_(nh, pnh, diagnostics_, estimator_, tf_, vehicle_.frames.odom),
        publisher_(nh, params_.lockstep, vehicle_.frames.odom,
                   params_.publish_tf ? params_.window_frame : std::string()) {
    const int queue = queueFor(params_.lockstep, 10);
    window_.subscribe(nh, 1, &PoseNode::receiveWindow, this);
    odom_.subscribe(nh, queue, &PoseNode::receiveOdometry, this);
    reset_ = advertise<std_srvs::Trigger>(pnh, "reset", [this](auto&) { return reset(); });
    if (params_.gravity_source == "imu") {
      imu_.emplace(diagnostics_, "imu");
      imu_->subscribe(nh, queue, &PoseNode::receiveImu, this);
    }
    if (params_.gravity_source == "tf") {
      tf_attitude_.emplace(tf_, vehicle_.frames.odom, vehicle_.frames.base);
      diagnostics_.add("attitude", [this] { return tf_attitude_->health(); });
    }
    if (!params_.publish_tf) diagnostics_.addOutput("window_pose", publisher_.topics());
    diagnostics_.add("camera mounting", [this] { return mountingHealth(); });
    diagnostics_.add("frames check", [this] { return framesHealth(estimator_.frames()); });
    diagnostics_.add("clocks", [this] { return clocksHealth(estimator_.clockOffset(), odom_clock_); });
    diagnostics_.add("consistency", [this] { return consistencyHealth(consistency_); });
    diagnostics_.add("openness", [this] { return opennessHealth(estimator_.openness()); });
    diagnostics_.add("target", [this] { return targetHealth(unused_, sizeSaid()); });
    if (params_.lockstep) {
      lockstep_.emplace(
          nh, diagnostics_, [this](const auto& step) { return isComplete(step); },
          [this](const auto&) { processPending(true); });
    } else {
      diagnostics_.afterEachMessage([this] { processPending(false); });
      timer_ =
          diagnostics_.createTimer(nh, kPendingPeriodSec, "pending image", [this] { processPending(false); });
    }
  }

 private:
  PoseNodeParams readChecked(ros::NodeHandle& nh, ros::NodeHandle& pnh) {
    auto params = configuration::forVehicle(readParameters<PoseNodeParams>(nh, pnh, vehicle_), vehicle_);
    if (params.lockstep && params.gravity_source == "tf")
      throw InputError("gravity_source is 'tf', must be imu or odom in lockstep");
    return params;
  }

  bool isComplete(const Lockstep::Step& step) const {
    const bool connected =
        camera_.input().isConnected() && odom_.isConnected() && (!imu_ || imu_->isConnected());
    if (!step.has_image && !(connected && mountingOf(tf_, vehicle_.frames.base, step.header.frame_id)))
      return false;
    return window_.lastStamp() >= step.image && odom_.lastStamp() >= step.odom &&
           (!imu_ || imu_->lastStamp() >= step.imu) && camera_.input().lastStamp() >= step.camera_info;
  }

  bool isFromBeforeReset(const std_msgs::Header& header) const {
    return !lockstep_ && header.stamp <= forgotten_;
  }

  void receiveWindow(const window_ingress::WindowDetectionConstPtr& message) {
    restartIfClockJumpedBack();
    if (!window_.admits(message->header.stamp) || isFromBeforeReset(message->header)) return;
    window_.accepted();
    window_.stamped(message->header.stamp.toSec());
    if (!lockstep_) processPending(true);
    pending_ = message;
    pending_since_sec_ = steadyNowSec();
  }

  void receiveOdometry(const nav_msgs::OdometryConstPtr& message) {
    restartIfClockJumpedBack();
    if (!odom_.admits(message->header.stamp) || isFromBeforeReset(message->header)) return;
    auto vehicle = fromMsg(*message, vehicle_.frames);
    if (!vehicle) return odom_.refused(vehicle.reason);
    odom_.accepted(twist_.look(*vehicle.value));
    odom_.stamped(vehicle.value->stamp_sec);
    if (!lockstep_)
      vehicle.value->stamp_sec = odom_clock_.atReceiver(vehicle.value->stamp_sec, ros::Time::now().toSec());
    estimator_.addOdometry(vehicle.value->stamp_sec, vehicle.value->T_odom_base,
                           vehicle.value->velocity_odom_mps, vehicle.value->turn_odom_radps);
    odometry_stamp_sec_ = vehicle.value->stamp_sec;
  }

  void receiveImu(const sensor_msgs::ImuConstPtr& message) {
    imu_->admits(message->header.stamp);
    const auto attitude = fromMsg(*message, vehicle_.frames.base);
    if (!attitude) return imu_->refused(attitude.reason);
    imu_->accepted();
    double stamp_sec = attitude.value->stamp_sec;
    imu_->stamped(stamp_sec);
    if (!lockstep_) stamp_sec = imu_clock_.atReceiver(stamp_sec, ros::Time::now().toSec());
    estimator_.addAttitude(stamp_sec, attitude.value->R_odom_base);
  }

  // An image waits until odometry has reached its exposure, because poses are interpolated, not extrapolated.
  void processPending(bool however_old) {
    if (!pending_) return;
    const bool caught_up = odometry_stamp_sec_ >= pending_->header.stamp.toSec();
    const bool waited = steadyNowSec() - pending_since_sec_ >= params_.odom_wait_sec;
    const bool hopeless = odom_.silentSec() > kOdometryGoneSec;
    if (!(caught_up || waited || hopeless || however_old)) return;
    const window_ingress::WindowDetectionConstPtr message = pending_;
    pending_.reset();
    process(*message);
  }

  void process(const window_ingress::WindowDetection& message) {
    window_ingress::WindowPose out;
    out.header = message.header;
    out.size = toMsg(sizeSaid());
    Refusal unused = estimate(message, out);
    out.openness = toMsg(estimator_.openness());
    if (const auto& measured = estimator_.measuredSize()) out.measured_size = toMsg(*measured);
    VerifiedTarget verified;
    verified.frames = estimator_.frames();
    const auto state = estimator_.filtered(message.header.stamp.toSec());
    if (state) {
      out.filtered = toMsg(*state);
      out.size = toMsg(state->size);
      verified = {verified.frames,
                  estimator_.fit(*state),
                  state->consistency,
                  estimator_.otherWindow(),
                  estimator_.approachForbidden(*state),
                  estimator_.unverified()};
    } else if (unused.reason.empty()) {
      unused = {window_ingress::FilteredPose::REFUSED, "no image was used recently"};
    }
    if (state)
      unused_ = UnusedImages();
    else if (message.detected)
      unused_.add(unused.reason, out.image.apparent);
    out.filtered.header.frame_id = vehicle_.frames.odom;
    out.filtered.reject = unused.reject;
    out.filtered.reason = unused.reason;
    out.checks = toMsg(verified);
    consistency_ = verified.consistency;
    publisher_.publish(out, state);
    selection_.publish(message.header.stamp, publisher_.markers());
  }

  struct Refusal {
    std::uint8_t reject;
    std::string reason;
  };

  // Fills in what this image shows. Returns why the image did not contribute to the filter; empty if it did.
  Refusal estimate(const window_ingress::WindowDetection& message, window_ingress::WindowPose& out) {
    using Filtered = window_ingress::FilteredPose;
    using Image = window_ingress::ImagePose;
    T_base_camera_ = mountingOf(tf_, vehicle_.frames.base, message.header.frame_id);
    auto window = fromMsg(message);
    if (window && message.image_width == 0) window = {std::nullopt, "image_width is zero"};
    if (!window) {
      out.image.reject = Image::NO_WINDOW;
      out.image.reason = window.reason;
    }
    if (message.image_width == 0) return {Filtered::NO_WINDOW, window.reason};  // no image
    const auto camera = camera_.cameraOf(static_cast<int>(message.image_width),
                                         static_cast<int>(message.image_height), message.header);
    const auto stamp_sec = stampSec(message.header.stamp);
    if (camera && T_base_camera_)
      out.camera = toMsg(navigation::cameraInBody(*camera.value, *T_base_camera_.value));
    else
      out.camera.fault = camera ? T_base_camera_.reason : "no calibration: " + camera.reason;
    if (out.camera.fault.empty())
      out.camera.fault = navigation::whyNotMounted(*T_base_camera_.value, vehicle_);
    if (out.camera.fault.empty() && !lockstep_ && odom_.silentSec() > kOdometryGoneSec)
      out.camera.fault = "the pose node has no odometry: " + odom_.health().text;
    if (!camera && window) {
      out.image.reject = Image::NO_CALIBRATION;
      out.image.reason = camera.reason;
      return {Filtered::NO_CALIBRATION, camera.reason};
    }
    if (!camera || !stamp_sec) return {Filtered::NO_WINDOW, window.reason};
    if (tf_attitude_)
      if (const auto R_odom_base = tf_attitude_->at(*stamp_sec))
        estimator_.addAttitude(*stamp_sec, *R_odom_base);
    estimator_.addDetection(
        {*stamp_sec, *camera.value, T_base_camera_.value, window.value, seenWindowsFrom(message)});
    estimator_.flush();
    out.target =
        targetMsg(estimator_.facade().target(),
                  T_base_camera_ ? estimator_.expected(*stamp_sec, *camera.value, *T_base_camera_.value)
                                 : std::nullopt);
    if (!window) return {Filtered::NO_WINDOW, window.reason};
    const estimation::TargetUpdate& update = estimator_.lastUpdate();
    out.image = toMsg(update.pose);
    if (update.pose.estimate) out.size = toMsg(update.pose.estimate->opening);
    if (!T_base_camera_) return {Filtered::NO_MOUNTING, T_base_camera_.reason};
    return {update.why_not.empty() ? Filtered::OK : Filtered::REFUSED, update.why_not};
  }

  void restartIfClockJumpedBack() {
    if (!clock_.jumpedBack(ros::Time::now().toSec())) return;
    ROS_WARN("the clock jumped back: odometry, transforms and filter forgotten");
    forgotten_ = ros::Time();
    forget();
    tf_.clear();
  }

  void forget() {
    odometry_stamp_sec_ = -1.0;
    odom_clock_.clear();
    imu_clock_.clear();
    pending_.reset();
    estimator_.reset();
    consistency_ = estimation::Consistency();
    unused_ = UnusedImages();
    publisher_.clear(ros::Time::now());
    selection_.tellAnew(ros::Time::now());
  }

  Reply reset() {
    forgotten_ = ros::Time::now();
    forget();
    const Reply reply{true, "the track and the memory of all windows are forgotten"};
    ROS_INFO("reset: %s", reply.message.c_str());
    return reply;
  }

  Health mountingHealth() const {
    if (T_base_camera_) return {};
    const bool no_image_yet = window_.silentSec() > kSilenceSec;
    return {no_image_yet ? Health::kOk : Health::kError, T_base_camera_.reason};
  }

  geometry::OpeningSize sizeSaid() const {
    return {params_.pose.opening_width_m, params_.pose.opening_height_m};
  }

  navigation::VehicleParams vehicle_;
  PoseNodeParams params_;
  Diagnostics diagnostics_;
  TopicInput window_, odom_;
  std::optional<TopicInput> imu_;
  std::optional<Lockstep> lockstep_;
  estimation::SenderClock odom_clock_, imu_clock_;
  navigation::EmptyTwist twist_;
  ClockWatch clock_;
  CameraSource camera_;
  estimation::TargetEstimator estimator_;
  estimation::Consistency consistency_;
  UnusedImages unused_;
  double odometry_stamp_sec_ = -1.0;
  ros::Time forgotten_;  // messages up to this stamp describe a world that no longer exists
  window_ingress::WindowDetectionConstPtr pending_;
  double pending_since_sec_ = 0.0;  // on the steady clock
  Converted<Eigen::Isometry3d> T_base_camera_;

  tf2_ros::Buffer tf_;
  std::optional<TfAttitude> tf_attitude_;
  tf2_ros::TransformListener tf_listener_;
  WindowSelection selection_;
  PosePublisher publisher_;
  ros::ServiceServer reset_;
  ros::SteadyTimer timer_;
};

std::unique_ptr<Node> makeHomographyPose(ros::NodeHandle& nh, ros::NodeHandle& pnh) {
  return std::make_unique<PoseNode>(nh, pnh);
}

}  // namespace window_ingress::adapters
