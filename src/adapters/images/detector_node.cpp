#include "adapters/images/detector_node.hpp"

#include <sensor_msgs/Image.h>

#include <cmath>

#include "adapters/images/image_conversion.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "adapters/runtime/parameter_server.hpp"
#include "window_ingress/detection/debug_image.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {
constexpr double kLateSec = 0.5;  // an older pose does not describe the image
}

DetectorNode::DetectorNode(ros::NodeHandle& nh, ros::NodeHandle& pnh)
    : params_(readParameters<DetectorNodeParams>(nh, pnh, vehicle_, {"tuning"})),
      diagnostics_(nh, pnh),
      perception_(params_.detector, params_.interior),
      camera_(nh, diagnostics_, vehicle_.image_is_rectified),
      images_(nh, diagnostics_, params_.image_transport, params_.image,
              limitsFor(params_.lockstep, vehicle_.stamps),
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
  reference_subscriber_ = subscribeCatching<window_ingress::ReferenceImage>(
      nh, "reference", 1, diagnostics_, [this](const auto& message) { receiveReference(*message); });
  pose_subscriber_ = subscribeCatching<window_ingress::WindowPose>(
      nh, "window_pose", 1, diagnostics_, [this](const auto& message) { receivePose(message); });
  capture_ = pnh.advertiseService("capture_reference", &DetectorNode::captureReference, this);
  reset_ = pnh.advertiseService("reset", &DetectorNode::reset, this);
  diagnostics_.addOutput("window", {window_publisher_});
  diagnostics_.add("time", [this] { return times_.health(); });
  diagnostics_.add("detection", [this] { return detectionHealth(); });
  diagnostics_.add("reference", [this] { return referenceHealth(); });
  if (!params_.lockstep) return;
  lockstep_.emplace(
      nh, diagnostics_, [this](const auto& step) { return isComplete(step); },
      [this](const auto& step) { lookInStep(step); });
  camera_.notify([this] { lockstep_->check(); });
  if (attitude_) attitude_->notify([this] { lockstep_->check(); });
}

void DetectorNode::receivePose(const window_ingress::WindowPoseConstPtr& message) {
  last_pose_ = message;
  if (lockstep_) lockstep_->check();
}

// The previous image's pose says where the target is expected in this one.
bool DetectorNode::hasPoseOfLastImage() const {
  if (pose_subscriber_.getNumPublishers() == 0 || looked_.isZero()) return true;
  return last_pose_ && last_pose_->header.stamp >= looked_;
}

bool DetectorNode::isComplete(const Lockstep::Step& step) const {
  const bool connected = images_.isConnected() && camera_.isConnected() &&
                         (!attitude_ || attitude_->isConnected(step.header.frame_id));
  return (step.has_image ? waiting_header_.stamp >= step.image : connected) &&
         (!attitude_ || attitude_->lastStamp() >= step.imu) && camera_.lastStamp() >= step.camera_info &&
         reference_stamp_ >= step.reference && hasPoseOfLastImage();
}

// Answers before the first image as well, so that waiting nodes learn that this node runs.
void DetectorNode::lookInStep(const Lockstep::Step& step) {
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

void DetectorNode::receive(const std_msgs::Header& header, const DecodedImage& decoded) {
  if (!lockstep_) return look(header, decoded);
  waiting_header_ = header;
  waiting_ = decoded;
  lockstep_->check();
}

void DetectorNode::restartIfClockJumpedBack() {
  if (!clock_.jumpedBack(ros::Time::now().toSec())) return;
  ROS_WARN("the clock jumped back: the track is forgotten");
  perception_.reset();
  last_pose_.reset();
}

void DetectorNode::look(const std_msgs::Header& header, const DecodedImage& decoded) {
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

void DetectorNode::publishDebugImage(const std_msgs::Header& header, const cv::Mat& image,
                                     double milliseconds) {
  const auto& window = perception_.window();
  detection::drawDetection(image, perception_.trace(), window ? &*window : nullptr, canvas_, milliseconds);
  const std::string yaw = yawAt(header.stamp);
  if (window && !yaw.empty()) detection::drawYaw(canvas_, *window, yaw);
  debug_publisher_.publish(toImageMsg(canvas_, header));
}

// Expected place of the target, from the memory of all windows after the previous image.
std::optional<geometry::Quadrilateral> DetectorNode::expectedAt(const std_msgs::Header& header) const {
  if (!last_pose_ || last_pose_->header.frame_id != header.frame_id ||
      std::abs(header.stamp.toSec() - last_pose_->header.stamp.toSec()) > perception::kExpectationLastsSec)
    return std::nullopt;
  return expectedFrom(last_pose_->target);
}

// Yaw of the previous image, because this image's pose is not known yet. Empty if there is no recent one.
std::string DetectorNode::yawAt(const ros::Time& stamp) const {
  if (!last_pose_ || last_pose_->image.reject != window_ingress::ImagePose::OK ||
      std::abs(stamp.toSec() - last_pose_->header.stamp.toSec()) > kLateSec)
    return "";
  const window_ingress::RelativeYaw& yaw = last_pose_->image.relative_yaw;
  return geometry::yawText(yaw.angle, yaw.sigma, yaw.sign_trusted != 0);
}

void DetectorNode::receiveReference(const window_ingress::ReferenceImage& message) {
  use(makeReference(message, params_.image, params_.detector), "topic");
  ROS_INFO("reference taken from %s", reference_subscriber_.getTopic().c_str());
  reference_stamp_ = message.image.header.stamp;
  if (lockstep_) lockstep_->check();
}

void DetectorNode::use(const detection::ReferenceAppearance& reference, const std::string& source) {
  perception_.setReference(reference);
  reference_is_guess_ = !reference.openingIsKnown();
  reference_from_ = source + (detection::isGrey(reference.image()) ? ", which has no colour" : "") +
                    (reference.openingIsKnown() ? "" : ", opening guessed: give reference/corners");
}

// Why no reference can be captured; empty if one can.
std::string DetectorNode::captureFault() const {
  if (last_image_.image.empty()) return "no image so far";
  if (!perception_.window()) return "no window in the last image: " + perception_.trace().detail;
  if (!perception_.window()->whole()) return "the window is not whole in the last image";
  return detection::isGrey(last_image_.image) ? "the images have no colour" : "";
}

bool DetectorNode::captureReference(Trigger::Request&, Trigger::Response& response) {
  response.message = captureFault();
  response.success = response.message.empty();
  if (!response.success) return true;
  const detection::ReferenceAppearance reference(last_image_.image, perception_.window()->corners);
  use(reference, "live image");
  response.message = "the window in the last image is now the reference";
  if (params_.reference.capture_file.empty()) return true;
  try {
    const std::string file = unusedReferenceFile(params_.reference.capture_file);
    saveReference(file, reference);
    response.message += "; written to " + file;
  } catch (const InputError& error) {
    response.success = false;
    response.message += std::string(", but it is not saved: ") + error.what();
  }
  return true;
}

bool DetectorNode::reset(Trigger::Request&, Trigger::Response& response) {
  perception_.reset();
  response.success = true;
  response.message = "the track is forgotten; the next image is searched";
  return true;
}

Health DetectorNode::detectionHealth() const {
  if (last_image_.image.empty()) return {Health::kOk, "no image so far"};
  const double silent_sec = steadyNowSec() - searched_sec_;
  if (silent_sec > kSilenceSec)
    return {Health::kWarn, formatted("no image for %.0f s", std::floor(silent_sec))};
  return {Health::kOk, perception_.window() ? "window in view" : "no window: " + perception_.trace().detail};
}

Health DetectorNode::referenceHealth() const {
  if (reference_from_.empty()) return {Health::kOk, "none: windows are recognised by geometry only"};
  std::string text = "from " + reference_from_;
  if (perception_.window())
    text += perception_.window()->has_appearance
                ? formatted("; distance %.3f", perception_.window()->bhattacharyya)
                : "; not compared in the last image, geometry only";
  return {reference_is_guess_ ? Health::kWarn : Health::kOk, text};
}

}  // namespace window_ingress::adapters
