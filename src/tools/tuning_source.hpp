/// Where tune_detector has its images from: files, a bag, or a camera that runs.
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "adapters/bags/bag_topics.hpp"
#include "adapters/bags/labelled_bag.hpp"
#include "adapters/images/image_from_msg.hpp"
#include "command_line.hpp"

namespace window_ingress::tools {

/// Images with a place among them, or the newest of a camera.
class TuningSource {
 public:
  virtual ~TuningSource() = default;
  virtual cv::Mat picture() = 0;           ///< where we are; empty: none yet
  virtual std::string name() = 0;          ///< for people
  virtual void step(int) {}                ///< to another place
  virtual int count() const { return 0; }  ///< 0: a camera
};

class StoredPictures : public TuningSource {
 public:
  void add(const std::string& name, const cv::Mat& picture) {
    names_.push_back(name), pictures_.push_back(picture);
  }
  cv::Mat picture() override { return pictures_[at_]; }
  std::string name() override {
    return names_[at_] + " (" + std::to_string(at_ + 1) + " of " + std::to_string(pictures_.size()) + ")";
  }
  void step(int by) override {
    const auto size = static_cast<int>(pictures_.size());
    at_ = static_cast<std::size_t>(((static_cast<int>(at_) + by) % size + size) % size);
  }
  int count() const override { return static_cast<int>(pictures_.size()); }

 private:
  std::size_t at_ = 0;
  std::vector<std::string> names_;
  std::vector<cv::Mat> pictures_;
};

class Camera : public TuningSource {
 public:
  explicit Camera(const std::string& topic) : topic_(topic) {
    raw_ = nh_.subscribe<sensor_msgs::Image>(topic, 1, [this](const sensor_msgs::ImageConstPtr& message) {
      take(adapters::decode(message, adapters::ImageLimits{}));
    });
    compressed_ = nh_.subscribe<sensor_msgs::CompressedImage>(
        topic + "/compressed", 1, [this](const sensor_msgs::CompressedImageConstPtr& message) {
          take(adapters::decode(*message, adapters::ImageLimits{}));
        });
  }
  cv::Mat picture() override {
    ros::spinOnce();
    return picture_;
  }
  std::string name() override { return topic_ + (refusal_.empty() ? "" : ", refused: " + refusal_); }

 private:
  void take(const adapters::DecodedImage& guarded) {
    refusal_ = guarded.reason;
    if (!guarded.image.empty()) picture_ = guarded.image.clone();
  }
  std::string topic_, refusal_;
  cv::Mat picture_;
  ros::NodeHandle nh_;
  ros::Subscriber raw_, compressed_;
};

inline void addFile(const std::filesystem::path& path, StoredPictures& pictures) {
  const cv::Mat picture = cv::imread(path.string(), cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (!picture.empty()) pictures.add(path.filename().string(), picture);
}

/// \param source image, folder, bag, or the name of a topic
/// \param every, most of a bag: one image in so many, and no more than so many. \throws UsageError
inline std::unique_ptr<TuningSource> openSource(const std::string& source, const std::string& image_topic,
                                                int every, int most) {
  namespace fs = std::filesystem;
  const bool exists = fs::exists(source);
  if (!exists && source.rfind('/', 0) == 0 && source.find('.') == std::string::npos) {
    if (!ros::master::check())
      throw UsageError(source + ": no such file, and no ROS master to ask for a topic");
    return std::make_unique<Camera>(source);
  }
  if (!exists) throw UsageError(source + ": no such picture, folder or bag; a topic begins with '/'");
  auto pictures = std::make_unique<StoredPictures>();
  if (fs::is_directory(source)) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(source)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files)
      if (cv::haveImageReader(file.string())) addFile(file, *pictures);
  } else if (fs::path(source).extension() == ".bag") {
    rosbag::Bag bag;
    adapters::openBag(bag, source);
    adapters::BagTopics wanted;
    wanted.image = image_topic;
    const auto topics = adapters::chooseTopics(bag, wanted);
    int number = 0;
    for (const cv::Mat& picture : adapters::picturesOf(bag, topics, every, most))
      pictures->add("picture " + std::to_string(every * number++) + " of " + topics.image, picture);
  } else {
    addFile(source, *pictures);
  }
  if (pictures->count() == 0) throw UsageError(source + ": no picture in it that can be read");
  return pictures;
}

}  // namespace window_ingress::tools
