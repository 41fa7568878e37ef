#include "evaluation/flights/flight_picture.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace window_ingress::evaluation::flight_picture_test {

using simulation::Outcome;

FlightResult straightFlight(Outcome outcome, double y_m) {
  FlightResult flight;
  flight.outcome = outcome;
  for (int i = 0; i <= 50; ++i) flight.track.push_back({0.1 * i, {-5.0 + 0.1 * i, y_m, 0.0}});
  return flight;
}

// Rows below the legend that contain this colour.
cv::Range rowsOf(const cv::Mat& image, const cv::Scalar& colour) {
  cv::Mat mask, rows;
  cv::inRange(image, colour, colour, mask);
  mask.rowRange(0, 60) = 0;
  cv::reduce(mask, rows, 1, cv::REDUCE_MAX);
  cv::Mat found;
  cv::findNonZero(rows, found);
  if (found.empty()) return {0, 0};
  return {found.at<cv::Point>(0).y, found.at<cv::Point>(static_cast<int>(found.total()) - 1).y + 1};
}

TEST(Tracks, LeftIsUpAndEachOutcomeHasItsColour) {
  const auto image =
      drawTracks({straightFlight(Outcome::kPassed, 1.0), straightFlight(Outcome::kCollision, -1.0)},
                 simulation::Scenario(), "two flights");
  const cv::Range passed = rowsOf(image, {60, 160, 40}), collision = rowsOf(image, {30, 30, 220});
  ASSERT_GT(passed.size(), 0);
  ASSERT_GT(collision.size(), 0);
  EXPECT_LT(passed.start, collision.start) << "y is left, and left is up";
}

TEST(Tracks, NoFlightsAreNoCrash) {
  EXPECT_FALSE(drawTracks({}, simulation::Scenario(), "none").empty());
  EXPECT_FALSE(drawTracks({FlightResult()}, simulation::Scenario(), "no track").empty());
}

TEST(FlightStrip, ShowsTheFirstPictureOfEachStateAndTheLastOne) {
  FlightStrip strip;
  EXPECT_TRUE(strip.draw(straightFlight(Outcome::kTimeout, 0.0), simulation::Scenario()).empty());
  simulation::CameraFrame frame;
  frame.image = cv::Mat(240, 320, CV_8UC3, cv::Scalar(40, 80, 120));
  FlightRecord record;
  const auto heightAfter = [&](navigation::State state) {
    record.state = state;
    strip.onImage(frame, {}, std::nullopt);
    strip.onStep(record, {});
    return strip.draw(straightFlight(Outcome::kTimeout, 0.0), simulation::Scenario()).rows;
  };
  const int one_row = heightAfter(navigation::State::kSearch);
  EXPECT_EQ(heightAfter(navigation::State::kSearch), one_row) << "one picture a state";
  EXPECT_EQ(heightAfter(navigation::State::kAlign), one_row);
  EXPECT_GT(heightAfter(navigation::State::kApproach), one_row)
      << "three states and the last picture: two rows";
}

}  // namespace window_ingress::evaluation::flight_picture_test
