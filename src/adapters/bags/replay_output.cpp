#include "adapters/bags/replay_output.hpp"

#include <rosbag/view.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "evaluation/csv.hpp"
#include "window_ingress/detection/debug_image.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

using Json = nlohmann::ordered_json;

// Seconds with all nine decimals, which a double cannot hold.
std::string exactText(const ros::Time& stamp) { return formatted("%u.%09u", stamp.sec, stamp.nsec); }

std::string useOf(const std::string& topic, const BagTopics& topics) {
  if (topic == topics.image) return "image";
  if (topic == topics.camera_info) return "camera-info";
  if (topic == topics.odom) return "odom";
  if (topic == topics.imu) return "imu";
  if (topic == topics.truth) return "truth";
  return topic == "/tf_static" ? "camera mounting" : "";
}

Json topicsOf(const rosbag::Bag& bag, const BagTopics& used) {
  Json topics = Json::array();
  for (const auto& [topic, type] : typesByTopic(bag))
    topics.push_back({{"topic", topic},
                      {"type", type},
                      {"messages", messagesIn(bag, topic)},
                      {"used_as", useOf(topic, used)}});
  return topics;
}

Json countsOf(const ReplaySummary& summary) {
  return {{"images", summary.images},
          {"without_calibration", summary.images - summary.calibrated},
          {"without_odometry", summary.images - summary.with_odometry},
          {"without_attitude", summary.images - summary.with_attitude},
          {"jumps_back_in_time", summary.jumps},
          {"messages_refused", summary.refused},
          {"refused_because", summary.reasons}};
}

std::string shellQuoted(const std::string& argument) {
  constexpr const char* kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=./,:@%";
  if (!argument.empty() && argument.find_first_not_of(kPlain) == std::string::npos) return argument;
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

constexpr const char* kFilteredColumns =
    ",filtered_qx,filtered_qy,filtered_qz,filtered_qw,filtered_tx,filtered_ty,filtered_tz,filtered_sigma_x,"
    "filtered_sigma_y,filtered_sigma_z,filtered_sigma_roll,filtered_sigma_pitch,filtered_sigma_yaw";
constexpr const char* kTruthColumns =
    ",truth_whole,truth_iou,truth_distance_m,truth_yaw_rad,error_yaw_rad,error_distance_m,error_corner_px";
constexpr const char* kOpennessColumns = ",openness,openness_log_odds,depth_behind_m";
constexpr const char* kDetailColumns =
    "stamp,has_calibration,has_odometry,has_attitude,sides_seen,yaw_rad,sigma_u_rad,sign_trusted,theta_rad,"
    "phi_rad,psi_rad,opening_width_m,opening_height_m,left_side_px,right_side_px,filtered_age_sec,filtered_"
    "sign_trusted,filtered_weight,window_width_m,window_height_m,why_not_filtered\n";
constexpr int kPoseDetails = 10, kFilterDetails = 5;

// Each number after a comma.
std::string csvNumbers(const char* pattern, std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text += "," + formatted(pattern, number);
  return text;
}

std::string filteredValues(const std::optional<estimation::FilteredWindow>& filtered) {
  if (!filtered) return std::string(13, ',');
  const Eigen::Quaterniond q(filtered->T_odom_window.linear());
  const Eigen::Vector3d t = filtered->T_odom_window.translation();
  std::string values =
      csvNumbers("%.9f", {q.x(), q.y(), q.z(), q.w()}) + csvNumbers("%.6f", {t.x(), t.y(), t.z()});
  for (int i = 0; i < 6; ++i)
    values += csvNumbers("%.6f", {std::sqrt(std::max(0.0, filtered->covariance(i, i)))});
  return values;
}

std::string truthValues(const evaluation::TruthErrors& errors) {
  std::string values = errors.whole ? ",1" : ",0";
  values += csvNumbers("%.6f", {errors.iou, errors.true_distance_m, errors.true_yaw_rad});
  for (const auto& value : {errors.yaw_rad, errors.distance_m})
    values += value ? csvNumbers("%.6f", {*value}) : ",";
  if (!errors.found || !errors.truth) return values + ",";
  return values + csvNumbers("%.4f", {geometry::furthestCorner(*errors.found, *errors.truth)});
}

std::string opennessValues(const openness::OpennessVerdict& verdict) {
  return formatted(",%s,%.4f,", openness::toString(verdict.openness), verdict.log_odds) +
         (verdict.has_depth ? formatted("%.4f", verdict.depth_behind_m) : "");
}

std::string poseDetails(const std::optional<estimation::WindowPoseEstimate>& pose) {
  if (!pose) return std::string(kPoseDetails, ',');
  return formatted(",%.6f,%.6f,%d", pose->yaw_rad, pose->sigma_u_rad, pose->sign_trusted) +
         csvNumbers("%.6f",
                    {pose->euler.roll_rad, pose->euler.pitch_rad, pose->euler.yaw_rad, pose->opening_width_m,
                     pose->opening_height_m, pose->left_side_px, pose->right_side_px});
}

std::string filterDetails(const std::optional<estimation::FilteredWindow>& filtered) {
  if (!filtered) return std::string(kFilterDetails, ',');
  const geometry::OpeningSize& size = filtered->size.size;
  return formatted(",%.3f,%d", filtered->age_sec, filtered->sign_trusted) +
         csvNumbers("%.6f", {filtered->hypothesis_weight, size.width_m, size.height_m});
}

/// Leaves the column of the processing time empty, because that time is not part of the bag.
std::string withoutMilliseconds(const std::string& values) { return values.substr(0, values.rfind(',') + 1); }

constexpr int kWidestPx = 640, kQuality = 80;

std::string captionOf(const ReplayedFrame& frame) {
  if (!frame.row.window) return "no window: " + frame.row.reject_reason;
  if (!frame.row.pose) return "window";
  return geometry::yawText(frame.row.pose->yaw_rad, frame.row.pose->yaw_sigma_rad,
                           frame.row.pose->sign_trusted);
}

}  // namespace

std::size_t messagesIn(const rosbag::Bag& bag, const std::string& topic) {
  return rosbag::View(bag, rosbag::TopicQuery(topic)).size();
}

void writeFacts(const std::filesystem::path& folder, const std::string& command, const rosbag::Bag& bag,
                const ReplayParams& params, const ReplaySummary& summary) {
  rosbag::View all(bag);
  Json facts;
  facts["command"] = command;
  facts["bag"] = {{"file", bag.getFileName()},
                  {"bytes", bag.getSize()},
                  {"begin", exactText(all.getBeginTime())},
                  {"seconds", (all.getEndTime() - all.getBeginTime()).toSec()}};
  facts["topics"] = topicsOf(bag, params.topics);
  if (params.with_pose)
    facts["window_size_m"] = {params.homography_pose.pose.opening_width_m,
                              params.homography_pose.pose.opening_height_m};
  facts["has_reference"] = params.reference.has_value();
  facts["counts"] = countsOf(summary);
  evaluation::OutputFile file(folder / "replay.json");
  file << facts.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
  file.finish();
}

std::string commandLine(int argc, char** argv) {
  std::string text = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "";
  for (int i = 1; i < argc; ++i) text += " " + shellQuoted(argv[i]);
  return text;
}

ReplayTables::ReplayTables(const std::filesystem::path& folder, const ReplayParams& params)
    : params_(params),
      has_truth_(!params.topics.truth.empty()),
      frames_(folder / "frames.csv"),
      details_(folder / "details.csv"),
      latency_(folder / "latency.csv") {
  frames_ << "stamp," << evaluation::detectionColumns() << kFilteredColumns
          << (has_truth_ ? kTruthColumns : "") << kOpennessColumns << "\n";
  details_ << kDetailColumns;
  latency_ << "stamp,detector_ms,pose_ms\n";
}

void ReplayTables::add(const ReplayedFrame& frame) {
  const std::string stamp = exactText(frame.stamp);
  frames_ << stamp << "," << withoutMilliseconds(evaluation::detectionValues(frame.row))
          << filteredValues(frame.filtered) << (has_truth_ ? compare(frame) : "")
          << opennessValues(frame.openness) << "\n";
  details_ << stamp << "," << frame.camera.has_value() << "," << frame.has_odometry << ","
           << frame.has_attitude << "," << (frame.row.window ? frame.row.window->visibleSides() : 0)
           << poseDetails(frame.row.pose) << filterDetails(frame.filtered) << ","
           << evaluation::csvField(frame.why_not_filtered) << "\n";
  latency_ << stamp << formatted(",%.3f,%.3f\n", frame.detector_ms, frame.pose_ms);
  for (evaluation::OutputFile* file : {&frames_, &details_, &latency_}) file->finish();
}

std::string ReplayTables::compare(const ReplayedFrame& frame) {
  if (!frame.truth || !frame.camera) return std::string(7, ',');
  std::optional<Eigen::Isometry3d> estimate;
  if (frame.row.pose) estimate = frame.row.pose->best.T_camera_window;
  const auto errors = evaluation::compareWithTruth(
      frame.row.window, estimate, *frame.truth, *frame.camera,
      {params_.homography_pose.pose.opening_width_m, params_.homography_pose.pose.opening_height_m});
  summary_.add(errors);
  return truthValues(errors);
}

DetectionStrip::DetectionStrip(const std::filesystem::path& folder, std::size_t images)
    : folder_(folder), step_(std::max<std::size_t>(1, (images + kMax - 1) / kMax)) {
  std::filesystem::remove_all(folder / "pictures");
  std::filesystem::create_directories(folder / "pictures");
  list_.open(folder / "strip.csv");
  list_ << "stamp,file,shown,caption\n";
}

const char* DetectionStrip::whyShown(const ReplayedFrame& frame) {
  const bool is_found = frame.row.window.has_value(), is_first = seen_ == 0;
  const bool changed = !is_first && is_found != was_found_;
  was_found_ = is_found;
  const bool is_due = seen_++ % step_ == 0;
  if (changed && changes_++ < kMaxChanges) return is_found ? "found" : "lost";
  return is_due ? "time" : nullptr;
}

void DetectionStrip::add(const ReplayedFrame& frame) {
  const char* why = whyShown(frame);
  if (!why || frame.image.empty() || !frame.perception) return;
  detection::drawDetection(frame.image, frame.perception->trace(),
                           frame.row.window ? &*frame.row.window : nullptr, canvas_);
  const double scale = std::min(1.0, static_cast<double>(kWidestPx) / canvas_.cols);
  cv::Mat small;
  cv::resize(canvas_, small, {}, scale, scale, cv::INTER_AREA);
  const std::string file = formatted("pictures/%05zu.jpg", seen_);
  evaluation::writeImage(folder_ / file, small, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  list_ << exactText(frame.stamp) << "," << file << "," << why << ","
        << evaluation::csvField(captionOf(frame)) << "\n";
  list_.finish();
}

}  // namespace window_ingress::adapters
