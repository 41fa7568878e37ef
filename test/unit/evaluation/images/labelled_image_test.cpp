#include "evaluation/images/labelled_image.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <set>

#include "drawn_window.hpp"
#include "evaluation/csv.hpp"
#include "refusal.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::evaluation::labelled_image_test {

const geometry::Quadrilateral kOpening{Eigen::Vector2d(220, 150), {420, 150}, {420, 310}, {220, 310}};

LabelledImage windowImage(unsigned seed = 1) {
  test::DrawnWindow window;
  window.opening = kOpening;
  window.frame_px = 14.0;
  window.seed = seed;
  return {"group", window.draw(), {kOpening}, std::nullopt};
}

LabelledImage wall() { return {"other", cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(190)), {}, std::nullopt}; }

TEST(DetectionCounts, RatesOfNothingAreOne) { EXPECT_DOUBLE_EQ(DetectionCounts().f1(), 1.0); }

TEST(DetectionCounts, SaysRatesWithTheirIntervals) {
  DetectionCounts counts;
  counts.found = 27, counts.missed = 3, counts.wrong = 1;
  EXPECT_TRUE(test::says(DetectionCounts().text(), "precision unknown (0 of 0)"));
  EXPECT_EQ(counts.text(),
            "recall 90.0 % (74.4 to 96.5 %, 27 of 30), precision 96.4 % (82.3 to 99.4 %, 27 of 28)");
  EXPECT_NEAR(counts.f1(), 54.0 / 58.0, 1e-12);
}

TEST(CountDetections, FoundMissedAndWrong) {
  LabelledImage elsewhere = windowImage(), unlabelled = windowImage(), missing = wall();
  for (auto& corner : elsewhere.targets[0]) corner += Eigen::Vector2d(150.0, 0.0);
  unlabelled.targets.clear();
  missing.targets = {kOpening};
  const auto count = [](const LabelledImage& sample) {
    return countDetections({sample}, detection::DetectorParams(), nullptr);
  };
  EXPECT_EQ(count(windowImage()).found, 1);
  EXPECT_GT(count(windowImage()).overlap, 0.95);
  EXPECT_EQ(count(elsewhere).missed, 1);
  EXPECT_EQ(count(elsewhere).wrong, 1);
  EXPECT_EQ(count(unlabelled).wrong, 1);
  EXPECT_EQ(count(missing).missed, 1);
  EXPECT_EQ(count(missing).wrong, 0);
  EXPECT_EQ(count(wall()).f1(), 1.0);
}

class LabelledFile : public testing::Test {
 protected:
  std::vector<LabelledImage> read(const std::string& text) {
    return readLabelled(folder_.write("labels.csv", text), folder_.path);
  }
  std::string errorOf(const std::string& text) {
    return test::refusalOf([&] { read(text); });
  }
  test::TemporaryFolder folder_;
  const std::string header_ = "file,label,x1,y1,x2,y2,x3,y3,x4,y4\n";
};

TEST_F(LabelledFile, ReadsTargetsNegativesAndWhatIsQuoted) {
  cv::imwrite(folder_.path / "a1.png", windowImage().image);
  cv::imwrite(folder_.path / "b.png", wall().image);
  const auto samples = read(header_ +
                            "a1.png,\"gate, red\",220,150,420,150,420,310,220,310\n"
                            "a1.png,gate,420,310,220,310,220,150,420,150\n"
                            "b.png,negative,,,,,,,,\n"
                            "b.png,pose_only_gate,1,1,5,1,5,5,1,5\n");
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_EQ(samples[0].targets.size(), 2u);
  EXPECT_EQ(samples[0].targets[1][0], kOpening[0]) << "from any corner on";
  EXPECT_EQ(samples[0].group, "a") << "neighbours in a video";
  EXPECT_TRUE(samples[1].targets.empty());
}

TEST_F(LabelledFile, WhatIsWrongIsNamedWithItsLine) {
  EXPECT_TRUE(test::says(errorOf(""), "empty"));
  EXPECT_TRUE(test::says(errorOf("file,x1\n"), "no column 'y1'"));
  EXPECT_TRUE(test::says(errorOf(header_), "no image"));
  EXPECT_TRUE(test::says(errorOf(header_ + "none.png,,1,1,5,1,5,5,1,5\n"), "none.png: cannot be read"));
  EXPECT_TRUE(
      test::says(errorOf(header_ + "\na.png,,1,1,5,1,5,nan,1,5\n"), "labels.csv:3: 'nan' is not a number"));
  EXPECT_TRUE(test::says(errorOf(header_ + "a.png,,1,1,5,5,5,1,1,5\n"), "not a convex quadrilateral"));
}

TEST(Labelled, WholeNoneAndInPart) {
  geometry::PinholeCamera camera;
  camera.width = 640, camera.height = 480;
  camera.fx = camera.fy = 500.0;
  camera.cx = 319.5, camera.cy = 239.5;
  const cv::Mat image(480, 640, CV_8UC1, cv::Scalar(0));
  const geometry::OpeningSize opening{1.2, 1.0};
  const Eigen::Matrix3d R_camera_window = geometry::R_optical_flu();
  const auto at = [&](double x, double z) {
    return labelled(image, geometry::makePose(R_camera_window, {x, 0.0, z}), camera, opening);
  };
  ASSERT_TRUE(at(0.0, 4.0));
  ASSERT_EQ(at(0.0, 4.0)->targets.size(), 1u);
  EXPECT_NEAR(at(0.0, 4.0)->targets[0][0].x(), 319.5 - 500.0 * 0.6 / 4.0, 1e-9);
  EXPECT_FALSE(at(2.4, 4.0)) << "cut by the border of the image";
  EXPECT_TRUE(at(9.0, 4.0)->targets.empty()) << "beside the image";
  EXPECT_TRUE(at(0.0, -4.0)->targets.empty()) << "behind the camera";
  EXPECT_FALSE(at(0.0, 0.5)) << "the image lies within it";
}

TEST(Split, KeepsGroupsTogetherAndIsDrawnByTheSeed) {
  std::vector<LabelledImage> samples;
  for (int i = 0; i < 40; ++i) {
    samples.push_back(wall());
    samples.back().group = "group " + std::to_string(i / 4);
    samples.back().image = cv::Mat(1, i + 1, CV_8U);
  }
  std::set<std::string> drawn;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const auto [tuned, held] = split(samples, 0.3, seed);
    EXPECT_EQ(held.size(), 12u);
    EXPECT_EQ(tuned.size(), 28u);
    std::string names;
    for (const auto& a : held) {
      names += std::to_string(a.image.cols) + " ";
      for (const auto& b : tuned) EXPECT_NE(a.group, b.group);
    }
    EXPECT_EQ(split(samples, 0.3, seed).second.front().image.cols, held.front().image.cols)
        << "the same for the same seed";
    drawn.insert(names);
  }
  EXPECT_GT(drawn.size(), 1u);
  EXPECT_EQ(split(samples, 0.0, 1).second.size(), 4u) << "at least one group";
  EXPECT_EQ(split(samples, 1.0, 1).first.size(), 4u);
  EXPECT_THROW(split({wall(), wall()}, 0.5, 1), std::invalid_argument);
}

}  // namespace window_ingress::evaluation::labelled_image_test
