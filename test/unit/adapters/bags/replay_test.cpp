#include "adapters/bags/replay.hpp"

#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <vector>

#include "adapters/bags/replay_output.hpp"
#include "adapters/images/image_conversion.hpp"
#include "adapters/pose/camera_mounting.hpp"
#include "refusal.hpp"

namespace window_ingress::adapters::replay_test {

namespace fs = std::filesystem;

constexpr int kImages = 12;
constexpr double kPeriodSec = 0.1;

/// A folder of its own for each test.
class ReplayTest : public ::testing::Test {
 protected:
  const test::TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path;
};

geometry::PinholeCamera camera() {
  geometry::PinholeCamera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 500.0;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

sensor_msgs::Image imageMessage(const std_msgs::Header& header, bool with_window) {
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar(190, 190, 190));
  cv::RNG random(5);
  cv::Mat noise(image.size(), CV_16SC3), noisy;
  random.fill(noise, cv::RNG::NORMAL, 0.0, 2.0);
  if (with_window) {
    cv::rectangle(image, {204, 134}, {436, 326}, {20, 95, 225}, cv::FILLED);
    cv::rectangle(image, {220, 150}, {420, 310}, {60, 50, 45}, cv::FILLED);
  }
  cv::add(image, noise, noisy, cv::noArray(), CV_8UC3);
  return *toImageMsg(noisy, header);
}

struct Recording {
  bool calibrated = true, with_odometry = true, with_imu = true;
  std::vector<double> starts = {100.0};  ///< each begins a pass over the same flight
};

void write(rosbag::Bag& bag, const std::string& topic, const ros::Time& at, const std::string& frame,
           const geometry::PinholeCamera& own) {
  sensor_msgs::CameraInfo info = toMsg(own);
  info.header.stamp = at;
  info.header.frame_id = frame;
  bag.write(topic, at, info);
}

nav_msgs::Odometry odometry(const ros::Time& stamp, double along_m) {
  nav_msgs::Odometry message;
  message.header.stamp = stamp;
  message.header.frame_id = "odom";
  message.child_frame_id = "base_link";
  message.pose.pose.position.x = along_m;
  message.pose.pose.orientation.w = 1.0;
  return message;
}

sensor_msgs::Imu imu(const ros::Time& stamp) {
  sensor_msgs::Imu message;
  message.header.stamp = stamp;
  message.header.frame_id = "base_link";
  message.orientation.w = 1.0;
  return message;
}

tf2_msgs::TFMessage mounting(const ros::Time& stamp) {
  tf2_msgs::TFMessage message;
  message.transforms = mountingOf(T_base_cameraOf({0.1, 0, 0, 0, 0, 0}), stamp, {}, "eye");
  return message;
}

// As recorded in a looped replay: the bag's clock continues, while the message stamps start again.
void record(const std::string& file, const Recording& recording) {
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  double received_sec = 1000.0;
  bag.write("/tf_static", ros::Time(received_sec), mounting(ros::Time(recording.starts.front())));
  for (const double start : recording.starts)
    for (int i = 0; i < kImages; ++i, received_sec += kPeriodSec) {
      const ros::Time at(received_sec), stamp(start + kPeriodSec * i);
      std_msgs::Header header;
      header.stamp = stamp;
      header.frame_id = "eye";
      bag.write("/eye/image_raw", at, imageMessage(header, i % 4 != 3));
      if (recording.calibrated) write(bag, "/eye/camera_info", at, "eye", camera());
      if (recording.with_odometry) bag.write("/odom", at, odometry(stamp, 1e-4 * i));
      if (recording.with_imu) bag.write("/imu", at - ros::Duration(0.001), imu(stamp));
    }
}

struct Result {
  std::vector<ReplayedFrame> frames;
  std::vector<std::string> jumps;
  ReplaySummary summary;
};

ReplayParams paramsFor(const rosbag::Bag& bag) {
  ReplayParams params;
  params.topics = chooseTopics(bag, {});
  params.with_pose = true;
  params.homography_pose.pose.opening_width_m = 1.25;
  return params;
}

Result replayed(const std::string& file) {
  rosbag::Bag bag;
  openBag(bag, file);
  Result result;
  result.summary = replay(
      bag, paramsFor(bag), [&](const ReplayedFrame& frame) { result.frames.push_back(frame); },
      [&](const std::string& text) { result.jumps.push_back(text); });
  return result;
}

std::string textOf(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<std::string> linesOf(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(ReplayTest, EveryImageIsAFrameWithWhatItCameWith) {
  record(folder_ / "a.bag", {});
  const Result result = replayed(folder_ / "a.bag");
  ASSERT_EQ(result.frames.size(), static_cast<std::size_t>(kImages));
  EXPECT_EQ(result.summary.images, kImages);
  EXPECT_EQ(result.summary.calibrated, kImages);
  EXPECT_EQ(result.summary.with_odometry, kImages);
  EXPECT_EQ(result.summary.with_attitude, kImages);
  EXPECT_EQ(result.summary.jumps, 0);
  EXPECT_EQ(result.summary.refused, 0) << result.summary.refusal;
  EXPECT_TRUE(result.frames[0].row.window.has_value()) << result.frames[0].row.reject_reason;
  EXPECT_TRUE(result.frames[0].row.pose.has_value()) << result.frames[0].row.reject_reason;
  EXPECT_TRUE(result.frames[kImages - 2].filtered.has_value()) << result.frames[kImages - 2].why_not_filtered;
  EXPECT_FALSE(result.frames[3].row.window.has_value());
  EXPECT_EQ(result.frames[3].why_not_filtered, "no window");
}

TEST_F(ReplayTest, WhatIsMissingIsCounted) {
  Recording bare;
  bare.with_odometry = bare.with_imu = false;
  record(folder_ / "bare.bag", bare);
  const Result result = replayed(folder_ / "bare.bag");
  EXPECT_EQ(result.summary.images, kImages);
  EXPECT_EQ(result.summary.with_odometry, 0);
  EXPECT_EQ(result.summary.with_attitude, 0);
  EXPECT_TRUE(result.frames[0].row.pose.has_value()) << "an image alone has a pose";
  EXPECT_FALSE(result.frames[0].filtered.has_value());
}

TEST_F(ReplayTest, AJumpBackInTimeForgetsEverything) {
  Recording twice;
  twice.starts = {100.0, 100.0};
  record(folder_ / "twice.bag", twice);
  const Result result = replayed(folder_ / "twice.bag");
  ASSERT_EQ(result.frames.size(), 2u * kImages);
  EXPECT_EQ(result.summary.jumps, 1);
  ASSERT_EQ(result.jumps.size(), 1u);
  EXPECT_NE(result.jumps[0].find("jumps back by 1.1 s"), std::string::npos) << result.jumps[0];
  for (int i = 0; i < kImages; ++i) {
    const ReplayedFrame &once = result.frames[static_cast<std::size_t>(i)],
                        &again = result.frames[static_cast<std::size_t>(i + kImages)];
    ASSERT_EQ(once.row.window.has_value(), again.row.window.has_value()) << i;
    if (once.row.window) {
      EXPECT_EQ(once.row.window->corners, again.row.window->corners) << i;
    }
    ASSERT_EQ(once.filtered.has_value(), again.filtered.has_value()) << i;
    if (!once.filtered) continue;
    EXPECT_EQ(once.filtered->T_odom_window.matrix(), again.filtered->T_odom_window.matrix()) << i;
    EXPECT_EQ(once.filtered->updates, again.filtered->updates) << i;
  }
}

TEST_F(ReplayTest, AJumpForwardIsNoJumpBack) {
  Recording later;
  later.starts = {100.0, 200.0};
  record(folder_ / "later.bag", later);
  EXPECT_EQ(replayed(folder_ / "later.bag").summary.jumps, 0);
}

TEST_F(ReplayTest, TablesHaveARowAnImageAndRepeatThemselves) {
  record(folder_ / "a.bag", {});
  for (const char* name : {"one", "two"}) {
    rosbag::Bag bag;
    openBag(bag, folder_ / "a.bag");
    const ReplayParams params = paramsFor(bag);
    fs::create_directories(folder_ / name);
    ReplayTables tables(folder_ / name, params);
    DetectionStrip strip(folder_ / name, messagesIn(bag, params.topics.image));
    const ReplaySummary summary = replay(bag, params, [&](const ReplayedFrame& frame) {
      tables.add(frame);
      strip.add(frame);
    });
    writeFacts(folder_ / name, "replay_bag --bag a.bag", bag, params, summary);
  }
  for (const char* table : {"frames.csv", "details.csv", "latency.csv", "strip.csv"}) {
    const auto lines = linesOf(folder_ / "one" / table);
    ASSERT_EQ(lines.size(), 1u + kImages) << table;
    const auto commas = [](const std::string& line) {  // commas between columns, not within quotes
      int count = 0, quotes = 0;
      for (const char c : line) {
        quotes += c == '"';
        count += c == ',' && quotes % 2 == 0;
      }
      return count;
    };
    for (const std::string& line : lines) EXPECT_EQ(commas(line), commas(lines[0])) << table << ": " << line;
  }
  for (const char* table : {"frames.csv", "details.csv", "strip.csv", "replay.json"})
    EXPECT_EQ(textOf(folder_ / "one" / table), textOf(folder_ / "two" / table)) << table;
}

TEST_F(ReplayTest, TheStripShowsEachChange) {
  record(folder_ / "a.bag", {});
  rosbag::Bag bag;
  openBag(bag, folder_ / "a.bag");
  DetectionStrip strip(folder_, 1000);  // expects many more frames: only the first is due
  replay(bag, paramsFor(bag), [&](const ReplayedFrame& frame) { strip.add(frame); });
  const auto lines = linesOf(folder_ / "strip.csv");
  ASSERT_GE(lines.size(), 4u);
  EXPECT_NE(lines[1].find(",time,"), std::string::npos);
  EXPECT_NE(lines[2].find(",lost,no window"), std::string::npos) << lines[2];
  EXPECT_NE(lines[3].find(",found,"), std::string::npos) << lines[3];
  EXPECT_TRUE(fs::exists(folder_ / "pictures/00001.jpg"));
}

TEST_F(ReplayTest, FactsNameTheTopicsAndTheirUse) {
  record(folder_ / "a.bag", {});
  rosbag::Bag bag;
  openBag(bag, folder_ / "a.bag");
  ReplaySummary summary;
  summary.reasons["image: \xff"] = 2;
  writeFacts(folder_, "replay_bag", bag, paramsFor(bag), summary);
  const auto facts = nlohmann::json::parse(textOf(folder_ / "replay.json"));
  ASSERT_EQ(facts["topics"].size(), 5u);
  EXPECT_EQ(facts["topics"][1]["used_as"], "image");
  EXPECT_EQ(facts["topics"][1]["messages"], kImages);
  EXPECT_EQ(facts["topics"][4]["used_as"], "camera mounting");
}

TEST(CommandLine, IsTakenApartAgainByAShell) {
  std::vector<std::string> words{"/usr/lib/replay_bag", "--bag",   "my flight's.bag",
                                 "--window-size",       "1.2,1.0", ""};
  std::vector<char*> given;
  for (std::string& word : words) given.push_back(word.data());
  EXPECT_EQ(commandLine(static_cast<int>(given.size()), given.data()),
            "replay_bag --bag 'my flight'\\''s.bag' --window-size 1.2,1.0 ''");
}

}  // namespace window_ingress::adapters::replay_test
