#include "adapters/bags/bag_check.hpp"

#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <fstream>
#include <iterator>
#include <random>

#include "adapters/bags/bag_reading.hpp"
#include "adapters/bags/replay.hpp"
#include "adapters/conversions/msg_conversion.hpp"
#include "refusal.hpp"

namespace window_ingress::adapters::bag_check_test {

/// A temporary folder with small bags.
class BagCheck : public testing::Test {
 protected:
  void write(rosbag::CompressionType compression = rosbag::compression::Uncompressed) {
    rosbag::Bag bag(file_, rosbag::bagmode::Write);
    bag.setCompression(compression);
    bag.setChunkThreshold(1500);
    for (int i = 0; i < 4; ++i) {
      sensor_msgs::Image image;
      image.header.stamp = ros::Time(100 + i);
      image.encoding = "mono8";
      image.width = image.step = 12, image.height = 8;
      image.data.assign(96, static_cast<std::uint8_t>(20 * i));
      bag.write("image_raw", image.header.stamp, image);
      sensor_msgs::CameraInfo info = toMsg(geometry::PinholeCamera::fromFieldOfView(12, 8, 1.0));
      info.header = image.header;
      bag.write("camera_info", image.header.stamp, info);
    }
  }
  std::vector<char> bytes() const {
    std::ifstream stream(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  void put(const std::vector<char>& content) const {
    std::ofstream(file_, std::ios::binary)
        .write(content.data(), static_cast<std::streamsize>(content.size()));
  }
  /// Opens and replays the bag. \return true if it was read to its end, false if it was refused by name
  bool replayed() const {
    const std::string refusal = test::refusalOf([&] {
      rosbag::Bag bag;
      openBag(bag, file_);
      ReplayParams params;
      params.topics = chooseTopics(bag, {});
      replay(bag, params, [](const ReplayedFrame&) {});
    });
    EXPECT_TRUE(refusal.empty() || refusal.find(file_) == 0) << refusal;
    return refusal.empty();
  }

  const test::TemporaryFolder folder_;
  const std::string file_ = folder_.path / "small.bag";
};

TEST_F(BagCheck, ABagIntoWhichNothingWasRecordedIsNotDamaged) {
  rosbag::Bag(file_, rosbag::bagmode::Write).close();
  EXPECT_EQ(whyDamaged(file_), "");
}

TEST_F(BagCheck, HasNothingAgainstWhatRosbagWrites) {
  for (const auto compression :
       {rosbag::compression::Uncompressed, rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    write(compression);
    EXPECT_EQ(whyDamaged(file_), "");
    EXPECT_TRUE(replayed());
  }
}

TEST_F(BagCheck, LeavesWhatIsNoBagToRosbag) {
  EXPECT_EQ(whyDamaged("/nowhere.bag"), "");
  put({});
  EXPECT_EQ(whyDamaged(file_), "");
  put(std::vector<char>(500, 'x'));
  EXPECT_EQ(whyDamaged(file_), "");
  const std::string old = "#ROSBAG V1.2\nand more of it";
  put({old.begin(), old.end()});
  EXPECT_NE(whyDamaged(file_).find("old version"), std::string::npos);
}

// rosbag takes tens of milliseconds to open a bag, so only some of the files are opened.
TEST_F(BagCheck, ABagThatIsCutOffAnywhereIsRefused) {
  write();
  const std::vector<char> whole = bytes();
  for (std::size_t length = 0; length < whole.size(); length += length + 400 < whole.size() ? 7 : 1) {
    put({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)});
    if (length > 13) {
      EXPECT_NE(whyDamaged(file_), "") << length;
    }
    if (length % 1001 == 0) {
      EXPECT_FALSE(replayed()) << length;
    }
  }
}

// Changes one bit or all bits of every byte in turn: rosbag must not crash.
TEST_F(BagCheck, FlippedBytesAreReadOrRefused) {
  write();
  const std::vector<char> whole = bytes();
  std::mt19937 random(1);
  int accepted = 0, refused = 0;
  for (std::size_t place = 0; place < whole.size(); place += 2) {
    std::vector<char> flipped = whole;
    flipped[place] = static_cast<char>(flipped[place] ^ (place % 3 == 0 ? 0xff : 1 << random() % 8));
    put(flipped);
    const bool sound = whyDamaged(file_).empty();
    ++(sound ? accepted : refused);
    if (sound && accepted % 89 == 0) replayed();
  }
  EXPECT_GT(accepted, 100) << "a flipped pixel is an image still";
  EXPECT_GT(refused, 100);
}

}  // namespace window_ingress::adapters::bag_check_test
