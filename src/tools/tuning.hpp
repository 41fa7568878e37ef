/// The detector that tune_detector adjusts, and its image source: files, a bag, or a live camera.
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapters/bags/bag_reading.hpp"
#include "adapters/images/image_conversion.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "command_line.hpp"
#include "evaluation/images/stage_sheet.hpp"
#include "evaluation/output_file.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::tools {

/// A list of images with a current one, or the newest image of a camera.
class TuningSource {
 public:
  virtual ~TuningSource() = default;
  virtual cv::Mat image() = 0;             ///< the current image; empty: none yet
  virtual std::string name() = 0;          ///< for people
  virtual void step(int) {}                ///< to another image
  virtual int count() const { return 0; }  ///< 0: a camera
};

class StoredImages : public TuningSource {
 public:
  void add(const std::string& name, const cv::Mat& image) { images_.emplace_back(name, image); }
  cv::Mat image() override { return images_[at_].second; }
  std::string name() override {
    return formatted("%s (%zu of %zu)", images_[at_].first.c_str(), at_ + 1, images_.size());
  }
  void step(int by) override {
    const auto size = static_cast<int>(images_.size());
    at_ = static_cast<std::size_t>(((static_cast<int>(at_) + by) % size + size) % size);
  }
  int count() const override { return static_cast<int>(images_.size()); }

 private:
  std::size_t at_ = 0;
  std::vector<std::pair<std::string, cv::Mat>> images_;
};

class Camera : public TuningSource {
 public:
  explicit Camera(const std::string& topic) : topic_(topic) {
    std::cout << "waiting for images on " << topic << " or " << topic << "/compressed" << std::endl;
    raw_ = nh_.subscribe<sensor_msgs::Image>(topic, 1, [this](const sensor_msgs::ImageConstPtr& message) {
      take(adapters::decode(message, adapters::ImageLimits{}));
    });
    compressed_ = nh_.subscribe<sensor_msgs::CompressedImage>(
        topic + "/compressed", 1, [this](const sensor_msgs::CompressedImageConstPtr& message) {
          take(adapters::decode(*message, adapters::ImageLimits{}));
        });
  }
  cv::Mat image() override {
    ros::spinOnce();
    return image_;
  }
  std::string name() override { return topic_ + (refusal_.empty() ? "" : ", refused: " + refusal_); }

 private:
  void take(const adapters::DecodedImage& guarded) {
    refusal_ = guarded.reason;
    if (!guarded.image.empty()) image_ = guarded.image.clone();
  }
  std::string topic_, refusal_;
  cv::Mat image_;
  ros::NodeHandle nh_;
  ros::Subscriber raw_, compressed_;
};

inline void addFile(const std::filesystem::path& path, StoredImages& images) {
  const cv::Mat image = evaluation::imageOrNone(path);
  if (image.empty())
    std::cerr << "tune_detector: " << path.string() << ": cannot be read as an image; skipped\n";
  else
    images.add(path.filename().string(), image);
}

/// \param source image, folder, bag, or the name of a topic
/// \param every, most of a bag: take every n-th image of a bag, and at most this many. \throws InputError
inline std::unique_ptr<TuningSource> openSource(const std::string& source, const std::string& image_topic,
                                                int every, int most) {
  namespace fs = std::filesystem;
  const bool exists = fs::exists(source);
  if (!exists && source.rfind('/', 0) == 0 && source.find('.') == std::string::npos) {
    if (!ros::master::check())
      throw InputError(source + ": no such file, and no ROS master to ask for a topic");
    return std::make_unique<Camera>(source);
  }
  if (!exists) throw InputError(source + ": no such image, folder or bag; a topic begins with '/'");
  auto images = std::make_unique<StoredImages>();
  if (fs::is_directory(source)) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(source)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files)
      if (evaluation::looksLikeImage(file)) addFile(file, *images);
  } else if (fs::path(source).extension() == ".bag") {
    rosbag::Bag bag;
    adapters::openBag(bag, source);
    adapters::BagTopics wanted;
    wanted.image = image_topic;
    const auto topics = adapters::chooseTopics(bag, wanted);
    int number = 0;
    for (const cv::Mat& image : adapters::imagesOf(bag, topics, every, most))
      images->add("image " + std::to_string(every * number++) + " of " + topics.image, image);
  } else {
    addFile(source, *images);
  }
  if (images->count() == 0) throw InputError(source + ": no image in it that can be read");
  return images;
}

using parameters::Field;

/// The detector with the current settings.
class Bench {
 public:
  Bench(const detection::DetectorParams& start, std::optional<detection::ReferenceAppearance> reference)
      : reference_(std::move(reference)),
        params_(start),
        fields_(parameters::fieldsOf(params_)),
        detector_(start),
        timer_(adapters::steadyNowSec) {
    detector_.setTimer(&timer_);
    if (reference_) detector_.setReference(*reference_);
  }

  const detection::DetectorParams& params() const { return params_; }
  const std::vector<Field>& fields() const { return fields_; }
  void changed() { detector_.setParams(params_); }

  /// \return one line: what was found, and how long it took
  std::string look(const cv::Mat& image) {
    const double begun_sec = adapters::steadyNowSec();
    timer_.begin();
    const auto window = detector_.detect(image, 0.0);
    milliseconds_ = 1e3 * (adapters::steadyNowSec() - begun_sec);
    found_ = window.has_value();
    std::string line = window ? formatted("window, score %.2f", window->score) : "no window";
    if (window && window->has_appearance)
      line += ", distance " + std::to_string(window->bhattacharyya).substr(0, 4);
    if (!window) line += ": " + detector_.trace().detail;
    return line + "; " + times();
  }

  cv::Mat sheet(const cv::Mat& image, int width) const {
    return evaluation::stageSheet(image, params_, reference_ ? &*reference_ : nullptr, width);
  }
  bool found() const { return found_; }
  double milliseconds() const { return milliseconds_; }

 private:
  std::string times() const {
    std::string line = formatted("%.1f ms", milliseconds_);
    for (int i = 0; i < detection::kStages; ++i) {
      const auto stage = static_cast<detection::Stage>(i);
      if (timer_.milliseconds(stage) < 0.05) continue;
      line += formatted(", %s %.1f", detection::toString(stage), timer_.milliseconds(stage));
    }
    return line;
  }

  std::optional<detection::ReferenceAppearance> reference_;
  detection::DetectorParams params_;
  std::vector<Field> fields_;  // refer to params_
  detection::WindowDetector detector_;
  detection::StageTimer timer_;
  bool found_ = false;
  double milliseconds_ = 0.0;
};

}  // namespace window_ingress::tools
