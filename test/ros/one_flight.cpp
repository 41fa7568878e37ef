/// For one_flight_test.py. Flies and records a flight, and writes from its recording what the nodes would
/// publish, once by replay and once by the closed loop's perception.
///   one_flight fly SCENARIO PARAMS FLIGHT.bag
///   one_flight see PARAMS FLIGHT.bag REPLAY.bag LOOP.bag
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CompressedImage.h>
#include <window_ingress/ReferenceImage.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapters/bags/bag_reading.hpp"
#include "adapters/bags/flight_bag.hpp"
#include "adapters/bags/replay.hpp"
#include "adapters/images/reference_source.hpp"
#include "evaluation/flights/closed_loop_flight.hpp"
#include "evaluation/flights/flight_perception.hpp"
#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/navigation/camera_in_body.hpp"

namespace {

using namespace window_ingress;
using detection::WindowObservation;

constexpr std::uint32_t kSeed = 1;

template <typename Message>
std::vector<boost::shared_ptr<Message>> messagesOf(const rosbag::Bag& bag, const std::string& topic) {
  std::vector<boost::shared_ptr<Message>> messages;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic)))
    messages.push_back(message.instantiate<Message>());
  return messages;
}

/// What is known before the flight.
struct Facts {
  Facts(const rosbag::Bag& bag, const std::string& params_file)
      : overlay(configuration::readOverlay(params_file)),
        reference(messagesOf<ReferenceImage>(bag, "/reference").at(0)) {
    adapters::RecordedTransforms transforms;
    for (const auto& message : messagesOf<tf2_msgs::TFMessage>(bag, "/tf_static")) transforms.take(*message);
    T_base_camera = transforms.between(frames.base, reference->image.header.frame_id).value.value();
  }

  detection::ReferenceAppearance appearance() const {
    const auto decoded =
        adapters::decode(boost::make_shared<sensor_msgs::Image>(reference->image), adapters::ImageLimits());
    std::vector<double> corners;
    for (std::size_t i = 0; i < 4; ++i)
      corners.insert(corners.end(), {reference->corner_x[i], reference->corner_y[i]});
    return adapters::makeReference(decoded.image, corners, overlay.window_detector.detector);
  }

  configuration::Overlay overlay;
  ReferenceImage::ConstPtr reference;
  adapters::FrameNames frames;
  Eigen::Isometry3d T_base_camera;
};

/// Writes what the detector and the pose node publish for an image, except for the processing time.
class Words {
 public:
  Words(const std::string& file, const Facts& facts) : bag_(file, rosbag::bagmode::Write), facts_(facts) {}

  void seen(const std_msgs::Header& header, const cv::Mat& image, const perception::WindowPerception& seen) {
    WindowDetection message = seen.window() ? adapters::toMsg(*seen.window()) : adapters::toMsg(seen.trace());
    for (const detection::SeenWindow& one : seen.windows()) message.windows.push_back(adapters::toMsg(one));
    message.header = header;
    message.image_width = static_cast<std::uint32_t>(image.cols);
    message.image_height = static_cast<std::uint32_t>(image.rows);
    reason_ = "no window: " + message.reason;
    is_seen_ = message.detected != 0;
    bag_.write("/window", header.stamp, message);
  }

  void located(const std_msgs::Header& header, const geometry::PinholeCamera& camera,
               const estimation::TargetEstimator& estimator) {
    WindowPose message;
    message.header = header;
    message.camera = adapters::toMsg(navigation::cameraInBody(camera, facts_.T_base_camera));
    message.target = adapters::targetMsg(
        estimator.facade().target(), estimator.expected(header.stamp.toSec(), camera, facts_.T_base_camera));
    message.openness = adapters::toMsg(estimator.openness());
    if (const auto& measured = estimator.measuredSize()) message.measured_size = adapters::toMsg(*measured);
    const auto& said = facts_.overlay.homography_pose.pose;
    message.size = adapters::toMsg(geometry::OpeningSize{said.opening_width_m, said.opening_height_m});
    tellImage(estimator.lastUpdate(), message);
    tellFiltered(header.stamp.toSec(), estimator, message);
    bag_.write("/window_pose", header.stamp, message);
  }

  void close() { bag_.close(); }

 private:
  void tellImage(const estimation::TargetUpdate& update, WindowPose& message) const {
    if (!is_seen_) {
      message.image.reject = ImagePose::NO_WINDOW;
      message.image.reason = reason_;
      return;
    }
    message.image = adapters::toMsg(update.pose);
    if (update.pose.estimate) message.size = adapters::toMsg(update.pose.estimate->opening);
  }

  void tellFiltered(double stamp_sec, const estimation::TargetEstimator& estimator,
                    WindowPose& message) const {
    std::uint8_t reject = FilteredPose::NO_WINDOW;
    std::string reason = reason_;
    if (is_seen_) reason = estimator.lastUpdate().why_not;
    if (is_seen_) reject = reason.empty() ? FilteredPose::OK : FilteredPose::REFUSED;
    adapters::VerifiedTarget verified;
    verified.frames = estimator.frames();
    if (const auto state = estimator.filtered(stamp_sec)) {
      message.filtered = adapters::toMsg(*state);
      message.size = adapters::toMsg(state->size);
      verified = {verified.frames,
                  estimator.fit(*state),
                  state->consistency,
                  estimator.otherWindow(),
                  estimator.approachForbidden(*state),
                  estimator.unverified()};
    } else if (reason.empty()) {
      reject = FilteredPose::REFUSED;
      reason = "no image was used recently";
    }
    message.filtered.header.frame_id = facts_.frames.odom;
    message.filtered.reject = reject;
    message.filtered.reason = reason;
    message.checks = adapters::toMsg(verified);
  }

  rosbag::Bag bag_;
  const Facts& facts_;
  std::string reason_;
  bool is_seen_ = false;
};

void seeAsReplay(const rosbag::Bag& bag, const Facts& facts, Words& words) {
  adapters::ReplayParams params{facts.overlay, adapters::chooseTopics(bag, {})};
  params.reference = facts.appearance();
  params.with_pose = true;
  adapters::replay(bag, params, [&](const adapters::ReplayedFrame& frame) {
    std_msgs::Header header;
    header.stamp = frame.stamp;
    header.frame_id = facts.reference->image.header.frame_id;
    words.seen(header, frame.image, *frame.perception);
    words.located(header, frame.camera.value(), *frame.estimator);
  });
}

/// Passes on the recorded messages in their order of arrival, as the world does in flight: no image waits.
class Loop {
 public:
  Loop(const Facts& facts, const evaluation::FlightParams& params, Words& words)
      : facts_(facts), words_(words), perception_(params) {
    perception_.setReference(facts.appearance());
  }

  void take(const rosbag::MessageInstance& message) {
    if (const auto odometry = message.instantiate<nav_msgs::Odometry>())
      takeOdometry(*odometry, message.getTime().toSec());
    else if (const auto imu = message.instantiate<sensor_msgs::Imu>())
      perception_.addAttitude(imu->header.stamp.toSec(),
                              adapters::fromMsg(*imu, imu->header.frame_id).value.value().R_odom_base);
    else if (const auto info = message.instantiate<sensor_msgs::CameraInfo>())
      perception_.calibrate(adapters::cameraFromMsg(*info, false).value.value());
    else if (const auto image = message.instantiate<sensor_msgs::CompressedImage>())
      look(*image);
  }

  /// Tells the estimator that no odometry follows the last image.
  void finish() {
    perception_.estimator().flush();
    tell();
  }

 private:
  void takeOdometry(const nav_msgs::Odometry& message, double arrival_sec) {
    const auto vehicle = adapters::fromMsg(message, facts_.frames).value.value();
    odometry_sec_ = perception_.addOdometry(vehicle, arrival_sec);
    tellIfLocated();
  }

  void look(const sensor_msgs::CompressedImage& message) {
    const cv::Mat image = adapters::decode(message, adapters::ImageLimits()).image;
    const double stamp_sec = message.header.stamp.toSec();
    const auto window = perception_.detect(image, stamp_sec, facts_.T_base_camera);
    words_.seen(message.header, image, perception_.perception());
    perception_.addDetection(stamp_sec, facts_.T_base_camera, window);
    waiting_ = message.header;
    tellIfLocated();
  }

  void tellIfLocated() {
    if (waiting_ && odometry_sec_ >= waiting_->stamp.toSec()) tell();
  }

  void tell() {
    if (waiting_) words_.located(*waiting_, perception_.camera().value(), perception_.estimator());
    waiting_.reset();
  }

  const Facts& facts_;
  Words& words_;
  evaluation::FlightPerception perception_;
  std::optional<std_msgs::Header> waiting_;  // an image that waits for odometry
  double odometry_sec_ = -1.0;
};

// A bag does not order messages of the same time. The flight takes them in the order of these topics.
void seeAsLoop(const rosbag::Bag& bag, const Facts& facts, const evaluation::FlightParams& params,
               Words& words) {
  const adapters::BagTopics t = adapters::chooseTopics(bag, {});
  const std::vector<std::string> topics{t.odom, t.imu, t.camera_info, t.image};
  rosbag::View view(bag, rosbag::TopicQuery(topics));
  const std::vector<rosbag::MessageInstance> messages(view.begin(), view.end());
  std::vector<const rosbag::MessageInstance*> sorted;
  for (const rosbag::MessageInstance& message : messages) sorted.push_back(&message);
  const auto place = [&](const rosbag::MessageInstance* message) {
    const auto found = std::find(topics.begin(), topics.end(), message->getTopic());
    return std::make_pair(message->getTime(), found - topics.begin());
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const auto* a, const auto* b) { return place(a) < place(b); });
  Loop loop(facts, params, words);
  for (const rosbag::MessageInstance* message : sorted) loop.take(*message);
  loop.finish();
}

void fly(const std::string& scenario, const std::string& params_file, const std::string& file) {
  adapters::FlightBag bag(file);
  const auto result = evaluation::flyOnce(simulation::loadScenario(scenario, kSeed), kSeed,
                                          {configuration::readOverlay(params_file)}, {&bag});
  std::cout << result.reason << std::endl;
}

void see(const std::string& params_file, const std::string& file, const std::string& replay_file,
         const std::string& loop_file) {
  rosbag::Bag bag;
  adapters::openBag(bag, file);
  const Facts facts(bag, params_file);
  Words replay(replay_file, facts), loop(loop_file, facts);
  seeAsReplay(bag, facts, replay);
  replay.close();
  seeAsLoop(bag, facts, {configuration::readOverlay(params_file)}, loop);
  loop.close();
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    if (words.size() == 4 && words[0] == "fly")
      fly(words[1], words[2], words[3]);
    else if (words.size() == 5 && words[0] == "see")
      see(words[1], words[2], words[3], words[4]);
    else
      return 2;
  } catch (const std::exception& error) {
    std::cerr << "one_flight: " << error.what() << std::endl;
    return 1;
  }
  return 0;
}
