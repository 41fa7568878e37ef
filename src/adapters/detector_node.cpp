#include "adapters/detector_node.hpp"

#include <sensor_msgs/Image.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "adapters/guarded.hpp"
#include "adapters/image_message.hpp"
#include "adapters/parameters.hpp"
#include "window_ingress/detection/debug_image.hpp"

namespace window_ingress::adapters {

detection::ReferenceAppearance makeReference(const cv::Mat& picture, const std::vector<double>& corners,
                                             const detection::DetectorParams& params) {
  if (corners.empty()) return detection::referenceFromPicture(picture, params);
  if (corners.size() != 8)
    throw ParameterError("reference/corners holds " + std::to_string(corners.size()) +
                         " numbers instead of 8");
  geometry::Quadrilateral quad;
  for (std::size_t i = 0; i < 4; ++i) quad[i] = {corners[2 * i], corners[2 * i + 1]};
  const auto canonical = geometry::canonical(quad);
  if (!canonical) throw ParameterError("reference/corners are no convex quadrilateral in cyclic order");
  return {picture, *canonical};
}

detection::ReferenceAppearance loadReference(const ReferenceParams& reference,
                                             const detection::DetectorParams& params) {
  const cv::Mat picture = cv::imread(reference.picture, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (picture.empty())
    throw ParameterError("reference/picture: cannot read '" + reference.picture + "' as an image");
  return makeReference(picture, reference.corners, params);
}

DetectorNode::DetectorNode(ros::NodeHandle& nh, ros::NodeHandle& pnh)
    : params_(readParameters<DetectorNodeParams>(pnh, {"tuning"})),
      diagnostics_(nh, pnh),
      detector_(params_.detector),
      camera_(nh, diagnostics_, params_.image_is_rectified),
      images_(nh, diagnostics_, params_.image_transport, params_.image,
              limitsFor(params_.lockstep, params_.stamps),
              [this](const auto& header, const auto& picture) { receive(header, picture); }),
      tuning_(pnh, params_.detector, [this](const auto& params) { detector_.setParams(params); }) {
  if (!params_.reference.picture.empty())
    detector_.setReference(loadReference(params_.reference, params_.detector));
  window_publisher_ = nh.advertise<window_ingress::WindowDetection>("window", 1, params_.lockstep);
  debug_publisher_ = nh.advertise<sensor_msgs::Image>("debug_image", 1);
  reference_subscriber_ = subscribeGuarded<window_ingress::ReferencePicture>(
      nh, "reference", 1, diagnostics_, [this](const auto& message) { receiveReference(*message); });
  capture_ = pnh.advertiseService("capture_reference", &DetectorNode::captureReference, this);
  reset_ = pnh.advertiseService("reset", &DetectorNode::reset, this);
  diagnostics_.add("detection", [this] { return detectionHealth(); });
  if (!params_.lockstep) return;
  lockstep_.emplace(
      nh, diagnostics_, [this](const auto& step) { return isComplete(step); },
      [this](const auto& step) { lookInStep(step); });
  camera_.notify([this] { lockstep_->check(); });
}

bool DetectorNode::isComplete(const Lockstep::Step& step) const {
  const bool connected = images_.isConnected() && camera_.isConnected();
  return (step.has_image ? waiting_header_.stamp >= step.image : connected) &&
         camera_.lastStamp() >= step.camera_info && reference_stamp_ >= step.reference;
}

// Before the first picture there is an answer, too: those who wait for it learn that this node is there.
void DetectorNode::lookInStep(const Lockstep::Step& step) {
  if (waiting_) look(waiting_header_, *waiting_);
  waiting_.reset();
  if (step.has_image || announced_ >= step.image) return;
  announced_ = step.image;
  window_ingress::WindowDetection message;
  message.header = step.header;
  message.header.stamp = step.image;
  message.reject_reason = "no picture so far";
  window_publisher_.publish(message);
}

void DetectorNode::receive(const std_msgs::Header& header, const GuardedImage& picture) {
  if (!lockstep_) return look(header, picture);
  waiting_header_ = header;
  waiting_ = picture;
  lockstep_->check();
}

void DetectorNode::look(const std_msgs::Header& header, const GuardedImage& picture) {
  const double begun_sec = steadyNowSec();
  const cv::Mat& image = picture.image;
  const auto camera = camera_.cameraOf(image.cols, image.rows, header.frame_id);
  detection::TrackInput seen;
  seen.image = image;
  seen.stamp_sec = header.stamp.toSec();
  seen.camera = camera ? &*camera.value : nullptr;
  last_window_ = detector_.update(seen);
  last_picture_ = picture;
  window_ingress::WindowDetection message;
  if (last_window_)
    message = toMsg(*last_window_);
  else
    message.reject_reason = detector_.trace().detail;
  message.header = header;
  message.image_width = static_cast<std::uint32_t>(image.cols);
  message.image_height = static_cast<std::uint32_t>(image.rows);
  message.milliseconds = (steadyNowSec() - begun_sec) * 1e3;
  slowest_ms_ = std::max(slowest_ms_, message.milliseconds);
  window_publisher_.publish(message);
  if (debug_publisher_.getNumSubscribers() > 0) publishDebugImage(header, image);
}

void DetectorNode::publishDebugImage(const std_msgs::Header& header, const cv::Mat& image) {
  detection::drawDetection(image, detector_.trace(), last_window_ ? &*last_window_ : nullptr, canvas_);
  debug_publisher_.publish(toImageMsg(canvas_, header));
}

void DetectorNode::receiveReference(const window_ingress::ReferencePicture& message) {
  const GuardedImage picture = decode(boost::make_shared<sensor_msgs::Image>(message.picture), params_.image);
  if (!picture.reason.empty()) throw ParameterError("reference picture: " + picture.reason);
  std::vector<double> corners;
  for (std::size_t i = 0; i < 4; ++i)
    corners.insert(corners.end(), {message.corner_x[i], message.corner_y[i]});
  const bool whole = std::all_of(corners.begin(), corners.end(), [](double number) { return number == 0.0; });
  detector_.setReference(
      makeReference(picture.image.clone(), whole ? std::vector<double>() : corners, params_.detector));
  ROS_INFO("reference taken from %s", reference_subscriber_.getTopic().c_str());
  reference_stamp_ = message.picture.header.stamp;
  if (lockstep_) lockstep_->check();
}

bool DetectorNode::captureReference(Trigger::Request&, Trigger::Response& response) {
  response.success = last_window_ && last_window_->whole() && last_picture_.image.channels() == 3;
  if (response.success) {
    detector_.setReference({last_picture_.image.clone(), last_window_->corners});
    response.message = "the window in the last image is the reference now";
  } else {
    response.message = !last_window_           ? "no window in the last image: " + detector_.trace().detail
                       : last_window_->whole() ? "the pictures have no colour"
                                               : "the window is not whole in the last image";
  }
  return true;
}

bool DetectorNode::reset(Trigger::Request&, Trigger::Response& response) {
  detector_.reset();
  response.success = true;
  response.message = "the track is forgotten; the next image is searched";
  return true;
}

Health DetectorNode::detectionHealth() const {
  const std::string slowest = "slowest image " + std::to_string(slowest_ms_) + " ms";
  if (last_picture_.image.empty()) return {Health::kOk, "no image so far"};
  return {Health::kOk,
          (last_window_ ? "window in view; " : "no window: " + detector_.trace().detail + "; ") + slowest};
}

}  // namespace window_ingress::adapters
