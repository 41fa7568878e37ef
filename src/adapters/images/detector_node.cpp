#include <sensor_msgs/Image.h>
#include <std_srvs/Trigger.h>
#include <window_ingress/ReferenceImage.h>
#include <window_ingress/WindowDetection.h>
#include <window_ingress/WindowDetectorConfig.h>
#include <window_ingress/WindowPose.h>

#include <cmath>

#include "adapters/images/image_conversion.hpp"
#include "adapters/images/image_source.hpp"
#include "adapters/images/processing_time.hpp"
#include "adapters/images/reference_source.hpp"
#include "adapters/images/unlike_reference.hpp"
#include "adapters/inputs/attitude_source.hpp"
#include "adapters/inputs/camera_source.hpp"
#include "adapters/nodes.hpp"
#include "adapters/runtime/lockstep.hpp"
#include "adapters/runtime/parameter_server.hpp"
#include "adapters/runtime/reconfigure.hpp"
#include "adapters/runtime/services.hpp"
#include "window_ingress/configuration/detector_node_params.hpp"
#include "window_ingress/detection/debug_image.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/perception/window_perception.hpp"

namespace window_ingress::adapters {
namespace {
constexpr double kLateSec = 0.5;  // an older pose does not describe the image
}

/// The detector between topics: images in, corners out, with or without calibration.
class DetectorNode : public Node {
 public:
  DetectorNode(ros::NodeHandle& nh, ros::NodeHandle& pnh)
      : params_(readParameters<configuration::DetectorNodeParams>(nh, pnh, vehicle_, {"tuning"})),
        diagnostics_(nh, pnh),
        perception_(params_.detector, params_.interior),
        camera_(nh, diagnostics_, vehicle_.image_is_rectified),
        images_(nh, diagnostics_, params_.image_transport, params_.image,
                limitsFor(params_.lockstep, vehicle_.stamps),
                RateLimit(params_.lockstep ? 0.0 : params_.max_rate_hz),
                [this](const auto& header, const auto& decoded) { receive(header, decoded); }),
        tuning_(pnh, params_.detector,
                [this](const auto& params) { perception_.setParams(params_.detector = params); }),
        times_(params_.budget_ms, steadyNowSec) {
    perception_.setTimer(&times_.timer());
    if (params_.use_imu)
      attitude_.emplace(nh, diagnostics_, vehicle_.frames.base, queueFor(params_.lockstep, 100));
    if (!params_.reference.picture.empty())
      use(loadReference(params_.reference, params_.detector), "photograph " + params_.reference.picture);
    window_publisher_ = nh.advertise<window_ingress::WindowDetection>("window", 1, params_.lockstep);
    debug_publisher_ = nh.advertise<sensor_msgs::Image>("debug_image", 1);
    reference_subscriber_ = diagnostics_.subscribe(nh, "reference", 1, &DetectorNode::receiveReference, this);
    pose_subscriber_ = diagnostics_.subscribe(nh, "window_pose", 1, &DetectorNode::receivePose, this);
    capture_ = advertise<Trigger>(pnh, "capture_reference", [this](auto&) { return captureReference(); });
    reset_ = advertise<Trigger>(pnh, "reset", [this](auto&) { return reset(); });
    diagnostics_.addOutput("window", {window_publisher_});
    diagnostics_.add("time", [this] { return times_.health(); });
    diagnostics_.add("detection", [this] { return detectionHealth(); });
    diagnostics_.add("reference", [this] { return referenceHealth(); });
    if (params_.lockstep)
      lockstep_.emplace(
          nh, diagnostics_, [this](const auto& step) { return isComplete(step); },
          [this](const auto& step) { lookInStep(step); });
  }

 private:
  using Trigger = std_srvs::Trigger;
  using Tuning = Reconfigure<window_ingress::WindowDetectorConfig, detection::DetectorParams>;

  void receivePose(const window_ingress::WindowPoseConstPtr& message) { last_pose_ = message; }

  // The previous image's pose says where the target is expected in this one.
  bool hasPoseOfLastImage() const {
    if (pose_subscriber_.getNumPublishers() == 0 || looked_.isZero()) return true;
    return last_pose_ && last_pose_->header.stamp >= looked_;
  }

  bool isComplete(const Lockstep::Step& step) const {
    const bool connected = images_.isConnected() && camera_.input().isConnected() &&
                           (!attitude_ || attitude_->isConnected(step.header.frame_id));
    return (step.has_image ? waiting_header_.stamp >= step.image : connected) &&
           (!attitude_ || attitude_->lastStamp() >= step.imu) &&
           camera_.input().lastStamp() >= step.camera_info && reference_stamp_ >= step.reference &&
           hasPoseOfLastImage();
  }

  // Answers before the first image as well, so that waiting nodes learn that this node runs.
  void lookInStep(const Lockstep::Step& step) {
    if (waiting_) look(waiting_header_, *waiting_);
    waiting_.reset();
    if (step.has_image || announced_ >= step.image) return;
    announced_ = step.image;
    window_ingress::WindowDetection message;
    message.header = step.header;
    message.header.stamp = step.image;
    message.reject = window_ingress::WindowDetection::NO_IMAGE;
    message.reason = "no image so far";
    window_publisher_.publish(message);
  }

  void receive(const std_msgs::Header& header, const DecodedImage& decoded) {
    if (!lockstep_) return look(header, decoded);
    waiting_header_ = header;
    waiting_ = decoded;
  }

  void restartIfClockJumpedBack() {
    if (!clock_.jumpedBack(ros::Time::now().toSec())) return;
    ROS_WARN("the clock jumped back: the track is forgotten");
    perception_.reset();
    last_pose_.reset();
  }

  void look(const std_msgs::Header& header, const DecodedImage& decoded) {
    restartIfClockJumpedBack();
    times_.begin(header, decoded.decode_ms);
    const cv::Mat& image = decoded.image;
    const auto camera = camera_.cameraOf(image.cols, image.rows, header);
    detection::TrackInput seen;
    seen.image = image;
    seen.stamp_sec = header.stamp.toSec();
    seen.camera = camera ? &*camera.value : nullptr;
    if (attitude_) seen.R_world_camera = attitude_->R_world_camera(seen.stamp_sec, header.frame_id);
    seen.expected = expectedAt(header);
    const auto& window = perception_.update(seen);
    searched_sec_ = steadyNowSec();
    unlike_.see(perception_.trace(), perception_.window().has_value());
    looked_ = header.stamp;
    last_image_ = decoded;
    window_ingress::WindowDetection message = window ? toMsg(*window) : toMsg(perception_.trace());
    for (const detection::SeenWindow& one : perception_.windows()) message.windows.push_back(toMsg(one));
    message.header = header;
    message.image_width = static_cast<std::uint32_t>(image.cols);
    message.image_height = static_cast<std::uint32_t>(image.rows);
    message.milliseconds = times_.sinceBegin();
    window_publisher_.publish(message);
    if (debug_publisher_.getNumSubscribers() > 0) publishDebugImage(header, image, message.milliseconds);
    times_.end();
  }

  void publishDebugImage(const std_msgs::Header& header, const cv::Mat& image, double milliseconds) {
    const auto& window = perception_.window();
    detection::drawDetection(image, perception_.trace(), window ? &*window : nullptr, canvas_, milliseconds);
    const std::string yaw = yawAt(header.stamp);
    if (window && !yaw.empty()) detection::drawYaw(canvas_, *window, yaw);
    debug_publisher_.publish(toImageMsg(canvas_, header));
  }

  // Expected place of the target, from the memory of all windows after the previous image.
  std::optional<geometry::Quadrilateral> expectedAt(const std_msgs::Header& header) const {
    if (!last_pose_ || last_pose_->header.frame_id != header.frame_id ||
        std::abs(header.stamp.toSec() - last_pose_->header.stamp.toSec()) > perception::kExpectationLastsSec)
      return std::nullopt;
    return expectedFrom(last_pose_->target);
  }

  // Yaw of the previous image, because this image's pose is not known yet. Empty if there is no recent one.
  std::string yawAt(const ros::Time& stamp) const {
    if (!last_pose_ || last_pose_->image.reject != window_ingress::ImagePose::OK ||
        std::abs(stamp.toSec() - last_pose_->header.stamp.toSec()) > kLateSec)
      return "";
    const window_ingress::RelativeYaw& yaw = last_pose_->image.relative_yaw;
    return geometry::yawText(yaw.angle, yaw.sigma, yaw.sign_trusted != 0);
  }

  void receiveReference(const window_ingress::ReferenceImageConstPtr& message) {
    use(makeReference(*message, params_.image, params_.detector), "topic");
    ROS_INFO("reference taken from %s", reference_subscriber_.getTopic().c_str());
    reference_stamp_ = message->image.header.stamp;
  }

  void use(const detection::ReferenceAppearance& reference, const std::string& source) {
    perception_.setReference(reference);
    reference_is_guess_ = !reference.openingIsKnown();
    reference_from_ = source + (detection::isGrey(reference.image()) ? ", which has no colour" : "") +
                      (reference.openingIsKnown() ? "" : ", opening guessed: give reference/corners");
  }

  // Why no reference can be captured; empty if one can.
  std::string captureFault() const {
    if (last_image_.image.empty()) return "no image so far";
    if (!perception_.window()) return "no window in the last image: " + perception_.trace().detail;
    if (!perception_.window()->whole()) return "the window is not whole in the last image";
    return detection::isGrey(last_image_.image) ? "the images have no colour" : "";
  }

  Reply captureReference() {
    if (const std::string fault = captureFault(); !fault.empty()) return {false, fault};
    const detection::ReferenceAppearance reference(last_image_.image, perception_.window()->corners);
    use(reference, "live image");
    const std::string said = "the window in the last image is now the reference";
    if (params_.reference.capture_file.empty()) return {true, said};
    try {
      const std::string file = unusedReferenceFile(params_.reference.capture_file);
      saveReference(file, reference);
      return {true, said + "; written to " + file};
    } catch (const InputError& error) {
      return {false, said + ", but it is not saved: " + error.what()};
    }
  }

  Reply reset() {
    perception_.reset();
    return {true, "the track is forgotten; the next image is searched"};
  }

  Health detectionHealth() const {
    if (last_image_.image.empty()) return {Health::kOk, "no image so far"};
    const double silent_sec = steadyNowSec() - searched_sec_;
    if (silent_sec > kSilenceSec)
      return {Health::kWarn, formatted("no image for %.0f s", std::floor(silent_sec))};
    if (perception_.window()) return {Health::kOk, "window in view"};
    return unlike_.health(perception_.trace().detail);
  }

  Health referenceHealth() const {
    if (reference_from_.empty()) return {Health::kOk, "none: windows are recognised by geometry only"};
    std::string text = "from " + reference_from_;
    if (perception_.window())
      text += perception_.window()->has_appearance
                  ? formatted("; distance %.3f", perception_.window()->bhattacharyya)
                  : "; not compared in the last image, geometry only";
    return {reference_is_guess_ ? Health::kWarn : Health::kOk, text};
  }

  navigation::VehicleParams vehicle_;
  configuration::DetectorNodeParams params_;
  Diagnostics diagnostics_;
  ClockWatch clock_;
  perception::WindowPerception perception_;
  CameraSource camera_;
  std::optional<AttitudeSource> attitude_;
  ImageSource images_;
  Tuning tuning_;
  cv::Mat canvas_;
  DecodedImage last_image_;
  UnlikeReference unlike_;
  double searched_sec_ = 0.0;  ///< time of the last searched image, on the steady clock
  bool reference_is_guess_ = false;
  std::string reference_from_;  // source of the reference; empty: no reference
  ProcessingTime times_;
  std::optional<Lockstep> lockstep_;
  std_msgs::Header waiting_header_;  // in lockstep: header of the image that waits for its step
  std::optional<DecodedImage> waiting_;
  ros::Time reference_stamp_, announced_, looked_;

  window_ingress::WindowPose::ConstPtr last_pose_;  // of an earlier image
  ros::Subscriber reference_subscriber_, pose_subscriber_;
  ros::Publisher window_publisher_, debug_publisher_;
  ros::ServiceServer capture_, reset_;
};

std::unique_ptr<Node> makeWindowDetector(ros::NodeHandle& nh, ros::NodeHandle& pnh) {
  return std::make_unique<DetectorNode>(nh, pnh);
}

}  // namespace window_ingress::adapters
