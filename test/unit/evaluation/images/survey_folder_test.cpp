#include "evaluation/images/survey_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "evaluation/csv.hpp"
#include "refusal.hpp"

namespace window_ingress::evaluation::survey_folder_test {

namespace fs = std::filesystem;

class SurveyFolderTest : public testing::Test {
 protected:
  static SurveyImage draw(bool with_reference, double k1 = 0.0, const std::string& lens = "plumb_bob") {
    simulation::Scenario scenario;
    scenario.camera.width_px = 160;
    scenario.camera.height_px = 120;
    scenario.camera.k1 = k1;
    scenario.camera.lens = lens;
    SurveyImage sample = takeImage(scenario, 3, ViewRange(), with_reference);
    sample.scenario = "calm";
    return sample;
  }

  test::TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path;
};

std::vector<SurveyImage> imagesIn(const fs::path& folder) {
  std::vector<SurveyImage> images;
  SurveyFolder(folder.string()).forEach([&](const SurveyImage& image) { images.push_back(image); });
  return images;
}

void expectSame(const geometry::Quadrilateral& a, const geometry::Quadrilateral& b) {
  for (int i = 0; i < 4; ++i) EXPECT_NEAR((a[i] - b[i]).norm(), 0.0, 1e-8);
}

TEST_F(SurveyFolderTest, LoadsWhatWasSaved) {
  const SurveyImage first = draw(true), bent = draw(false, -0.2);
  SurveyFolder saved(folder_.string());
  saved.add(first);
  saved.writeTable();
  const auto images = imagesIn(folder_);
  ASSERT_EQ(images.size(), 1u);
  const SurveyImage& loaded = images[0];
  EXPECT_EQ(loaded.scenario, "calm");
  EXPECT_EQ(loaded.seed, 3u);
  EXPECT_NEAR(loaded.distance_m, first.distance_m, 1e-6);
  EXPECT_EQ(cv::norm(loaded.image, first.image, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(loaded.reference, first.reference, cv::NORM_INF), 0.0);
  expectSame(loaded.truth.inner, first.truth.inner);
  expectSame(loaded.truth.far, first.truth.far);
  ASSERT_TRUE(loaded.truth.outer);
  expectSame(*loaded.truth.outer, *first.truth.outer);
  expectSame(loaded.reference_corners, first.reference_corners);
  EXPECT_EQ(loaded.camera.K(), first.camera.K());

  saved.add(bent);
  saved.writeTable();
  const auto both = imagesIn(folder_);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_TRUE(both[1].reference.empty());
  EXPECT_EQ(both[1].camera.distortion, bent.camera.distortion);
}

TEST_F(SurveyFolderTest, ALensStaysWhatItIs) {
  const SurveyImage fisheye = draw(false, -0.02, "equidistant");
  ASSERT_EQ(fisheye.camera.model, geometry::LensModel::kEquidistant);
  SurveyFolder saved(folder_.string());
  saved.add(fisheye);
  saved.writeTable();
  const auto images = imagesIn(folder_);
  ASSERT_EQ(images.size(), 1u);
  const geometry::PinholeCamera& loaded = images[0].camera;
  EXPECT_EQ(loaded.model, fisheye.camera.model);
  EXPECT_EQ(loaded.distortion, fisheye.camera.distortion);
}

TEST_F(SurveyFolderTest, FoldersThatAreNoneAreErrorsWithTheirName) {
  EXPECT_THROW(imagesIn(folder_), InputError) << "empty";
  std::ofstream(folder_ / "truth.csv") << "file,x\n1,2\n";
  EXPECT_THROW(imagesIn(folder_), InputError) << "of something else";
  SurveyFolder whole(folder_.string());
  whole.add(draw(false));
  whole.writeTable();
  fs::remove(folder_ / "calm_3.png");
  EXPECT_THROW(imagesIn(folder_), InputError) << "an image is missing";
  const fs::path below_a_file = folder_ / "truth.csv/folder";
  EXPECT_THROW(SurveyFolder(below_a_file.string()).writeTable(), std::runtime_error);
}

TEST_F(SurveyFolderTest, CutRowsAreErrors) {
  SurveyFolder saved(folder_.string());
  saved.add(draw(false));
  saved.writeTable();
  const auto size = fs::file_size(folder_ / "truth.csv");
  fs::resize_file(folder_ / "truth.csv", size - 60);
  EXPECT_THROW(imagesIn(folder_), InputError);
}

TEST(SurveyImage, AutomaticGainsHaveSettled) {
  simulation::Scenario scenario;
  scenario.camera.width_px = 160;
  scenario.camera.height_px = 120;
  scenario.camera.noise_grey = 0.0;
  scenario.camera.auto_exposure = true;
  scenario.camera.target_grey = 90.0;
  const SurveyImage sample = takeImage(scenario, 4, ViewRange(), false);
  const cv::Scalar mean = cv::mean(sample.image);
  EXPECT_NEAR((mean[0] + mean[1] + mean[2]) / 3.0, 90.0, 4.0);
}

TEST(SurveyImage, ClosedWallHasThePlaceButNoTarget) {
  simulation::Scenario scenario;
  scenario.window.present = false;
  scenario.camera.width_px = 160;
  scenario.camera.height_px = 120;
  const SurveyImage sample = takeImage(scenario, 4, ViewRange(), true);
  EXPECT_FALSE(sample.truth.present);
  EXPECT_FALSE(sample.reference.empty()) << "the reference shows what is looked for";
}

}  // namespace window_ingress::evaluation::survey_folder_test
