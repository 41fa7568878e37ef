// The table that tune_detector shows beside its sliders.
#include "tools/value_table.hpp"

#include <gtest/gtest.h>

namespace window_ingress::tools::value_table_test {

class ValueTable : public testing::Test {
 protected:
  detection::DetectorParams params_, defaults_;
  std::vector<parameters::Field> fields_ = parameters::fieldsOf(params_);
  std::vector<parameters::Field> as_default_ = parameters::fieldsOf(defaults_);
  std::string text(const std::string& name) const {
    return valueText(*parameters::find(fields_, name), *parameters::find(as_default_, name));
  }
};

TEST_F(ValueTable, ValuesHaveTheirUnits) {
  parameters::find(fields_, "edges/floor")->set(4.5);
  EXPECT_EQ(text("edges/floor"), "edges/floor = 4.5 grey levels a pixel  (default 6)");
  EXPECT_EQ(text("edges/low_ratio"), "edges/low_ratio = 0.5");
  parameters::find(fields_, "preprocess/search_side_px")->set(320.0);
  EXPECT_EQ(text("preprocess/search_side_px"), "preprocess/search_side_px = 320 px  (default 480)");
}

TEST_F(ValueTable, ShowsEveryFieldOfAGroup) {
  std::vector<const parameters::Field*> few(3, &fields_.front()), many(30, &fields_.front());
  const auto ink = [](const cv::Mat& table) {
    cv::Mat channel;
    cv::extractChannel(table, channel, 0);
    return cv::countNonZero(channel != 24);
  };
  const cv::Mat low = valueTable(few), high = valueTable(many);
  EXPECT_EQ(high.cols, low.cols);
  EXPECT_EQ(high.rows - 10, 10 * (low.rows - 10));
  EXPECT_NEAR(ink(high), 10 * ink(low), 0.01 * ink(high));
}

}  // namespace window_ingress::tools::value_table_test
