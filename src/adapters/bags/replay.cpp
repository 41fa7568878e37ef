#include "adapters/bags/replay.hpp"

#include <rosbag/exceptions.h>
#include <rosbag/view.h>

#include <algorithm>
#include <deque>
#include <new>
#include <stdexcept>

#include "adapters/images/reference_source.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/estimation/pose_buffer.hpp"

namespace window_ingress::adapters {
namespace {

/// Queue of a bag's images. Each image waits for the inputs of its exposure: odometry at least as new as the
/// image, and the attitude for a limited time only, because attitudes may have stopped.
class WaitingImages {
 public:
  struct Image {
    std_msgs::Header header;
    std::function<DecodedImage()> decode;
  };

  WaitingImages(bool for_odometry, bool for_attitude)
      : for_odometry_(for_odometry), for_attitude_(for_attitude) {}

  void add(Image image) { images_.push_back(std::move(image)); }
  void noteOdometry(double stamp_sec) { odometry_sec_ = stamp_sec; }
  void noteAttitude(double stamp_sec) { attitude_sec_ = stamp_sec; }

  /// The first image, if its inputs are complete. \param newest_sec newest stamp of all messages so far
  std::optional<Image> takeComplete(double newest_sec) {
    const bool too_many = images_.size() > kMaxWaiting;
    if (!too_many && (images_.empty() || !isComplete(images_.front(), newest_sec))) return std::nullopt;
    return take();
  }

  /// The first image, complete or not.
  std::optional<Image> take() {
    if (images_.empty()) return std::nullopt;
    std::optional<Image> first = std::move(images_.front());
    images_.pop_front();
    return first;
  }

  void clear() {
    images_.clear();
    odometry_sec_ = attitude_sec_ = -1.0;
  }

 private:
  static constexpr std::size_t kMaxWaiting = 30;
  static constexpr double kAttitudeWaitSec = 0.05;  // in the bag's time

  bool isComplete(const Image& image, double newest_sec) const {
    const double sec = image.header.stamp.toSec();
    const bool awaits_attitude = for_attitude_ && newest_sec < sec + kAttitudeWaitSec;
    return !(for_odometry_ && odometry_sec_ < sec) && !(awaits_attitude && attitude_sec_ < sec);
  }

  bool for_odometry_, for_attitude_;
  std::deque<Image> images_;
  double odometry_sec_ = -1.0, attitude_sec_ = -1.0;
};

class Replay {
 public:
  Replay(const ReplayParams& params, const std::function<void(const ReplayedFrame&)>& each,
         const std::function<void(const std::string&)>& jumped)
      : params_(params),
        each_(each),
        jumped_(jumped),
        waiting_(params.with_pose && !params.topics.odom.empty(), !params.topics.imu.empty()),
        perception_(params) {
    if (params.reference) perception_.setReference(*params.reference);
  }

  // Reads what is constant in a flight (calibration, mounting) and the truth, which is looked up by stamp.
  void prepare(const rosbag::Bag& bag) {
    rosbag::View infos(bag, rosbag::TopicQuery(params_.topics.camera_info));
    if (infos.begin() != infos.end())
      if (const auto info = infos.begin()->instantiate<sensor_msgs::CameraInfo>()) takeCamera(*info);
    for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery("/tf_static")))
      if (const auto transforms = message.instantiate<tf2_msgs::TFMessage>()) transforms_.take(*transforms);
    if (!params_.topics.truth.empty()) truth_ = recordedTruth(bag, params_.topics.truth);
  }

  void take(const rosbag::MessageInstance& message) {
    const std::string& topic = message.getTopic();
    if (topic == params_.topics.image) {
      if (const auto image = message.instantiate<sensor_msgs::Image>())
        takeImage(image->header, [this, image] { return decode(image, params_.window_detector.image); });
      else if (const auto compressed = message.instantiate<sensor_msgs::CompressedImage>())
        takeImage(compressed->header,
                  [this, compressed] { return decode(*compressed, params_.window_detector.image); });
    } else if (topic == params_.topics.camera_info) {
      if (const auto info = message.instantiate<sensor_msgs::CameraInfo>()) takeCamera(*info);
    } else if (topic == params_.topics.odom) {
      if (const auto odometry = message.instantiate<nav_msgs::Odometry>())
        takeOdometry(*odometry, message.getTime().toSec());
    } else if (topic == params_.topics.imu) {
      if (const auto imu = message.instantiate<sensor_msgs::Imu>()) takeImu(*imu);
    }
  }

  ReplaySummary finish() {
    processAll();
    return summary_;
  }

 private:
  void takeImage(const std_msgs::Header& header, std::function<DecodedImage()> decode) {
    if (!stampSec(header.stamp)) return refuse("image", "header.stamp is zero or not normalised");
    noticeJump(header.stamp);
    waiting_.add({header, std::move(decode)});
    processComplete();
  }

  void takeOdometry(const nav_msgs::Odometry& message, double arrival_sec) {
    const auto vehicle = fromMsg(message, params_.vehicle.frames);
    if (!vehicle) return refuse(params_.topics.odom, vehicle.reason);
    noticeJump(message.header.stamp);
    const auto& T_odom_base = vehicle.value->T_odom_base;
    const double stamp_sec = perception_.addOdometry(*vehicle.value, arrival_sec);
    odometry_.add(stamp_sec, T_odom_base);
    waiting_.noteOdometry(stamp_sec);
    processComplete();
  }

  void takeImu(const sensor_msgs::Imu& message) {
    const auto attitude = fromMsg(message, params_.vehicle.frames.base);
    if (!attitude) return refuse(params_.topics.imu, attitude.reason);
    noticeJump(message.header.stamp);
    perception_.addAttitude(attitude.value->stamp_sec, attitude.value->R_odom_base);
    waiting_.noteAttitude(attitude.value->stamp_sec);
    processComplete();
  }

  void takeCamera(const sensor_msgs::CameraInfo& message) {
    camera_ = cameraFromMsg(message, params_.vehicle.image_is_rectified);
    camera_frame_id_ = message.header.frame_id;
  }

  void noticeJump(const ros::Time& stamp) {
    const double sec = stamp.toSec(), back_sec = newest_sec_ - sec;
    if (back_sec <= kJumpSec) {
      newest_sec_ = std::max(newest_sec_, sec);
      return;
    }
    processAll();
    forgetAll();
    newest_sec_ = sec;
    ++summary_.jumps;
    if (jumped_)
      jumped_(formatted("time jumps back by %.1f s to %.3f: everything is forgotten", back_sec, sec));
  }

  void forgetAll() {
    perception_.forget();
    if (params_.reference)
      perception_.setReference(*params_.reference);  // discards the adaptation to the light
    odometry_.clear();
    waiting_.clear();
  }

  void processComplete() {
    while (const auto image = waiting_.takeComplete(newest_sec_)) process(*image);
  }

  void processAll() {
    while (const auto image = waiting_.take()) process(*image);
  }

  void process(const WaitingImages::Image& waiting) {
    const DecodedImage decoded = waiting.decode();
    if (!decoded.reason.empty()) return refuse("image", decoded.reason);
    ReplayedFrame frame;
    frame.stamp = waiting.header.stamp;
    frame.image = decoded.image;
    const auto camera = cameraOf(decoded.image, waiting.header.frame_id);
    if (!camera) refuse("camera_info", camera.reason);
    frame.camera = camera.value;
    const double stamp_sec = frame.stamp.toSec();
    frame.has_odometry = odometry_.at(stamp_sec, estimation::TargetEstimator::kMaxPoseGapSec).has_value();
    frame.has_attitude = perception_.knowsAttitude(stamp_sec);
    const auto mounted = transforms_.between(params_.vehicle.frames.base, waiting.header.frame_id);
    const double begun_ms = 1e3 * steadyNowSec();
    perception_.calibrate(frame.camera);
    frame.row.window = perception_.detect(decoded.image, stamp_sec, mounted.value);
    frame.perception = &perception_.perception();
    frame.estimator = &perception_.estimator();
    frame.detector_ms = 1e3 * steadyNowSec() - begun_ms;
    if (!frame.row.window) frame.row.reject_reason = detection::toString(frame.perception->trace().outcome);
    if (params_.with_pose) locate(frame, mounted);
    frame.pose_ms = 1e3 * steadyNowSec() - begun_ms - frame.detector_ms;
    count(frame);
    const auto truth = truth_.find(waiting.header.stamp);
    if (truth != truth_.end()) frame.truth = truth->second;
    each_(frame);
  }

  Converted<geometry::PinholeCamera> cameraOf(const cv::Mat& image, const std::string& frame_id) const {
    if (!camera_) return camera_;
    const std::string misfit = misfitOf(*camera_.value, camera_frame_id_, params_.topics.camera_info,
                                        image.cols, image.rows, frame_id);
    return misfit.empty() ? camera_ : Converted<geometry::PinholeCamera>{std::nullopt, misfit};
  }

  void locate(ReplayedFrame& frame, const Converted<Eigen::Isometry3d>& mounted) {
    const double stamp_sec = frame.stamp.toSec();
    perception_.addDetection(stamp_sec, mounted.value, frame.row.window);
    if (!frame.camera) return;
    perception_.estimator().flush();
    frame.why_not_filtered = "no window";
    if (frame.row.window) {
      if (!mounted) refuse("mounting of the camera", mounted.reason);
      const estimation::TargetUpdate& update = frame.estimator->lastUpdate();
      frame.row.pose = update.pose.estimate;
      frame.why_not_filtered = update.why_not;
      if (!frame.row.pose)
        frame.row.reject_reason = std::string("pose_") + estimation::toString(update.pose.reject);
    }
    frame.filtered = frame.estimator->filtered(stamp_sec);
    frame.openness = frame.estimator->openness();
  }

  void count(const ReplayedFrame& frame) {
    ++summary_.images;
    summary_.calibrated += frame.camera.has_value();
    summary_.with_odometry += frame.has_odometry;
    summary_.with_attitude += frame.has_attitude;
    summary_.milliseconds += frame.detector_ms + frame.pose_ms;
  }

  void refuse(const std::string& what, const std::string& why) {
    ++summary_.refused;
    ++summary_.reasons[what + ": " + withoutNumbers(why)];
    summary_.refusal = what + ": " + why;
  }

  const ReplayParams& params_;
  const std::function<void(const ReplayedFrame&)>& each_;
  const std::function<void(const std::string&)>& jumped_;
  WaitingImages waiting_;
  evaluation::FlightPerception perception_;
  estimation::PoseBuffer odometry_;
  Converted<geometry::PinholeCamera> camera_;
  std::string camera_frame_id_;
  RecordedTransforms transforms_;
  std::map<ros::Time, Eigen::Isometry3d> truth_;
  double newest_sec_ = -1.0;
  ReplaySummary summary_;
};

}  // namespace

std::optional<detection::ReferenceAppearance> recordedReference(const rosbag::Bag& bag,
                                                                const ReplayParams& params) {
  for (const rosbag::MessageInstance& message :
       rosbag::View(bag, rosbag::TypeQuery("window_ingress/ReferenceImage")))
    if (const auto reference = message.instantiate<window_ingress::ReferenceImage>())
      return makeReference(*reference, params.window_detector.image, params.window_detector.detector);
  return std::nullopt;
}

std::string recordedOdomFrame(const rosbag::Bag& bag, const std::string& topic) {
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic)))
    if (const auto odometry = message.instantiate<nav_msgs::Odometry>()) return odometry->header.frame_id;
  return "";
}

ReplaySummary replay(const rosbag::Bag& bag, const ReplayParams& params,
                     const std::function<void(const ReplayedFrame&)>& each,
                     const std::function<void(const std::string&)>& jumped) {
  Replay run(params, each, jumped);
  try {
    run.prepare(bag);
    const BagTopics& t = params.topics;
    rosbag::View view(bag,
                      rosbag::TopicQuery(std::vector<std::string>{t.image, t.camera_info, t.odom, t.imu}));
    for (const rosbag::MessageInstance& message : view) run.take(message);
  } catch (const ros::Exception& error) {  // from rosbag and from deserialisation
    throw InputError(bag.getFileName() + ": damaged: " + error.what());
  } catch (const std::bad_alloc&) {  // from lengths in a damaged message
    throw InputError(bag.getFileName() + ": damaged: a message needs more memory than there is");
  } catch (const std::length_error&) {
    throw InputError(bag.getFileName() + ": damaged: a message is longer than possible");
  }
  return run.finish();
}

}  // namespace window_ingress::adapters
