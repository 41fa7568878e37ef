#include "adapters/images/reference_source.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "adapters/runtime/parameter_server.hpp"
#include "drawn_window.hpp"
#include "refusal.hpp"

namespace window_ingress::adapters::reference_source_test {

namespace fs = std::filesystem;

class ReferenceSource : public ::testing::Test {
 protected:
  static test::DrawnWindow window() {
    test::DrawnWindow drawn;
    drawn.width = 320, drawn.height = 240, drawn.frame_px = 6;
    drawn.opening = test::rectangle(100.25, 80.5, 220, 170);
    return drawn;
  }
  const test::TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path;
};

TEST_F(ReferenceSource, WhatIsSavedIsLoadedWithTheParametersBesideIt) {
  const fs::path file = folder_ / "below" / "window's.png";
  const cv::Mat image = window().draw();
  saveReference(file.string(), {image, window().opening});
  const YAML::Node saved =
      YAML::LoadFile((folder_ / "below" / "window's.yaml").string())["window_detector"]["reference"];
  EXPECT_FALSE(cv::imread((folder_ / "below" / "window's_understood.png").string()).empty());
  ReferenceParams params;
  params.picture = saved["picture"].as<std::string>();
  params.corners = saved["corners"].as<std::vector<double>>();
  const auto reference = loadReference(params, {});
  EXPECT_EQ(cv::norm(reference.image(), image, cv::NORM_INF), 0.0);
  for (int i = 0; i < 4; ++i) EXPECT_LT((reference.opening()[i] - window().opening[i]).norm(), 1e-3);
}

TEST_F(ReferenceSource, WhatIsThereAlreadyIsKept) {
  const std::string file = (folder_ / "drone.png").string();
  EXPECT_EQ(unusedReferenceFile(file), file);
  std::ofstream(folder_ / "drone.yaml") << "vehicle: {}\n";
  EXPECT_EQ(unusedReferenceFile(file), (folder_ / "drone_2.png").string());
  saveReference(unusedReferenceFile(file), {window().draw(), window().opening});
  EXPECT_EQ(unusedReferenceFile(file), (folder_ / "drone_3.png").string());
}

TEST_F(ReferenceSource, WhatCannotBeWrittenIsSaid) {
  const cv::Mat image = window().draw();
  EXPECT_THROW(saveReference((folder_ / "a.nosuchformat").string(), {image, window().opening}), InputError);
  EXPECT_THROW(saveReference("/proc/nowhere/a.png", {image, window().opening}), InputError);
}

TEST_F(ReferenceSource, BadReferencesAreRefused) {
  const cv::Mat image = window().draw();
  EXPECT_THROW(makeReference(image, {1, 2, 3}, {}), InputError);
  EXPECT_THROW(makeReference(image, {1, 1, 1, 1, 1, 1, 1, 1}, {}), InputError);
  EXPECT_THROW(loadReference({}, {}), InputError);
  ReferenceParams params;
  params.picture = temporary_.write("text.png", "no image");
  EXPECT_THROW(loadReference(params, {}), InputError);
}

}  // namespace window_ingress::adapters::reference_source_test
