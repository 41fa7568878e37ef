#include <gtest/gtest.h>

#include <limits>

#include "adapters/bags/bag_reading.hpp"

namespace window_ingress::adapters::recorded_transforms_test {

tf2_msgs::TFMessage ahead(double x_m) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header.frame_id = "base_link";
  message.transforms[0].child_frame_id = "eye";
  message.transforms[0].transform.translation.x = x_m;
  message.transforms[0].transform.rotation.w = 1.0;
  return message;
}

TEST(RecordedTransforms, GiveThePoseOfOneFrameInAnother) {
  RecordedTransforms transforms;
  transforms.take(ahead(0.1));
  const auto T_base_eye = transforms.between("base_link", "eye");
  ASSERT_TRUE(T_base_eye) << T_base_eye.reason;
  EXPECT_DOUBLE_EQ(T_base_eye.value->translation().x(), 0.1);
  EXPECT_DOUBLE_EQ(transforms.between("eye", "base_link").value->translation().x(), -0.1);
}

TEST(RecordedTransforms, SayWhichFrameIsMissing) {
  RecordedTransforms transforms;
  transforms.take(ahead(0.1));
  const auto nothing = transforms.between("base_link", "nose");
  EXPECT_FALSE(nothing);
  EXPECT_NE(nothing.reason.find("nose"), std::string::npos) << nothing.reason;
}

TEST(RecordedTransforms, LeaveOutWhatIsNotFinite) {
  RecordedTransforms transforms;
  transforms.take(ahead(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(transforms.between("base_link", "eye"));
}

}  // namespace window_ingress::adapters::recorded_transforms_test
