#include "window_ingress/detection/window_detector.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "drawn_window.hpp"
#include "window_ingress/configuration/detector_node_params.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/parameters/yaml.hpp"

namespace window_ingress::detection::window_detector_test {

using test::DrawnWindow;

geometry::Quadrilateral randomOpening(std::mt19937& random, int width, int height) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const double w = uniform(0.09, 0.45) * width, h = w * uniform(0.7, 1.2) * 0.9;
  const double x = uniform(0.1, 0.9) * (width - 1.4 * w) + 0.7 * w,
               y = uniform(0.1, 0.9) * (height - 1.4 * h) + 0.7 * h;
  return test::turned(test::rectangle(x - w / 2, y - h / 2, x + w / 2, y + h / 2), uniform(-0.15, 0.15),
                      uniform(-0.2, 0.2));
}

/// One window of 1.2 m x 1.0 m with a frame of 7 cm, and views of it.
class Views {
 public:
  explicit Views(unsigned seed) : random_(seed) {}

  cv::Mat draw(const Eigen::Isometry3d& T_camera_window, geometry::Quadrilateral* opening) {
    DrawnWindow drawn;
    drawn.seed = static_cast<unsigned>(random_());
    drawn.frame_px = 0.0;
    cv::Mat image(drawn.height, drawn.width, CV_8UC3, drawn.wall);
    test::fillQuad(image, *geometry::projectOpening(camera_, T_camera_window, {1.34, 1.14}), drawn.frame);
    *opening = *geometry::canonical(*geometry::projectOpening(camera_, T_camera_window, {1.2, 1.0}));
    test::fillQuad(image, *opening, drawn.hole);
    cv::GaussianBlur(image, image, cv::Size(), 0.6);
    test::addNoise(image, 2.0, drawn.seed);
    return image;
  }

  /// 2 to 7 m away, up to 45 degrees off its axis, near the middle of the image.
  Eigen::Isometry3d pose() {
    const double distance = uniform(2.0, 7.0), yaw = uniform(-0.78, 0.78);
    const Eigen::Matrix3d rotation =
        geometry::R_optical_flu() * geometry::yawRotation(yaw) *
        Eigen::AngleAxisd(uniform(-0.1, 0.1), Eigen::Vector3d::UnitX()).toRotationMatrix();
    return geometry::makePose(rotation,
                              {uniform(-0.15, 0.15) * distance, uniform(-0.1, 0.1) * distance, distance});
  }

  static Eigen::Isometry3d square(double distance_m) {
    return geometry::makePose(geometry::R_optical_flu(), {0, 0, distance_m});
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  std::mt19937 random_;
  geometry::PinholeCamera camera_ = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.05);
};

int viewsFound(WindowDetector& detector, unsigned seed, int trials) {
  Views views(seed);
  int found = 0;
  for (int i = 0; i < trials; ++i) {
    geometry::Quadrilateral opening;
    const cv::Mat image = views.draw(views.pose(), &opening);
    const auto window = detector.detect(image, 0.1 * i);
    if (window && test::worstCorner(window->corners, opening) < 0.5) ++found;
    EXPECT_EQ(window.has_value(), detector.trace().target >= 0) << "view " << i;
  }
  return found;
}

TEST(WindowDetector, WithAReferenceFindsTheInnerBorderFromManyDistancesAndAngles) {
  Views views(1);
  geometry::Quadrilateral opening;
  const cv::Mat drawn = views.draw(Views::square(1.9), &opening);
  WindowDetector detector{DetectorParams()};
  detector.setReference(ReferenceAppearance(drawn, opening));
  EXPECT_GE(viewsFound(detector, 11, 60), 57);
}

// Far away the two borders of a thin frame merge at the resolution of the search, which finds the outer one.
TEST(WindowDetector, WithoutAReferenceFindsMostInnerBorders) {
  WindowDetector detector{DetectorParams()};
  EXPECT_GE(viewsFound(detector, 11, 60), 48);
}

TEST(WindowDetector, FindsBareHoles) {
  WindowDetector detector{DetectorParams()};
  std::mt19937 random(8);
  int found = 0;
  const int trials = 60;
  for (int i = 0; i < trials; ++i) {
    DrawnWindow drawn;
    drawn.opening = randomOpening(random, drawn.width, drawn.height);
    drawn.type = i % 2 ? CV_8UC1 : CV_8UC3;
    drawn.seed = i;
    const auto window = detector.detect(drawn.draw(), 0.1 * i);
    if (window && test::worstCorner(window->corners, drawn.opening) < 0.2) ++found;
  }
  EXPECT_GE(found, 57) << "of " << trials;
}

TEST(WindowDetector, TheReferenceChoosesAmongWindowsOfDifferentPaint) {
  DrawnWindow target, reference;
  reference.width = 320, reference.height = 240;
  reference.opening = test::rectangle(90, 70, 230, 170);
  reference.frame_px = 9;
  target.opening = test::rectangle(100, 150, 240, 250);
  target.frame_px = 9;
  cv::Mat image = target.draw();
  const auto decoy = test::rectangle(330, 120, 560, 290);
  test::fillQuad(image, test::grown(decoy, 14), cv::Scalar(190, 110, 30));
  test::fillQuad(image, decoy, cv::Scalar(70, 60, 50));
  WindowDetector detector{DetectorParams()};
  detector.setReference(ReferenceAppearance(reference.draw(), reference.opening));
  const auto window = detector.detect(image, 1.5);
  ASSERT_TRUE(window);
  EXPECT_EQ(window->stamp_sec, 1.5);
  EXPECT_TRUE(window->has_appearance);
  EXPECT_LT(test::worstCorner(window->corners, target.opening), 0.3);
  test::fillQuad(image, test::grown(target.opening, 15), target.wall);
  EXPECT_FALSE(detector.detect(image, 1.6)) << "only the decoy is left";
  EXPECT_LT(detector.trace().target, 0);
  detector.clearReference();
  EXPECT_TRUE(detector.detect(image, 1.7));
}

TEST(WindowDetector, AWindowCutByTheBorderIsNone) {
  WindowDetector detector{DetectorParams()};
  DrawnWindow drawn;
  drawn.opening = test::rectangle(-40, 120, 180, 330);
  EXPECT_FALSE(detector.detect(drawn.draw(), 0.0));
}

TEST(WindowDetector, TheSameImageGivesTheSameAnswerWhateverCameBefore) {
  DrawnWindow drawn;
  drawn.opening = test::turned(test::rectangle(220, 140, 420, 320), 0.1, 0.1);
  drawn.frame_px = 10;
  const cv::Mat image = drawn.draw();
  WindowDetector fresh{DetectorParams()}, used{DetectorParams()};
  used.detect(cv::Mat(1080, 1920, CV_8UC1, cv::Scalar(40)), 0.0);
  used.detect(cv::Mat(100, 90, CV_8UC3, cv::Scalar(40, 80, 90)), 0.1);
  const auto a = fresh.detect(image, 0.2), b = used.detect(image, 0.2);
  ASSERT_TRUE(a && b);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(a->corners[i], b->corners[i]);
  EXPECT_EQ(a->score, b->score);
}

TEST(WindowDetector, ImagesThatCannotHoldAWindowGiveAReason) {
  WindowDetector detector{DetectorParams()};
  for (const cv::Mat& image :
       {cv::Mat(), cv::Mat(1, 1, CV_8UC1, cv::Scalar(0)), cv::Mat(3, 900, CV_8UC3, cv::Scalar(9)),
        cv::Mat(480, 640, CV_16UC1, cv::Scalar(9)), cv::Mat(480, 640, CV_8UC4, cv::Scalar(9)),
        cv::Mat(480, 640, CV_32FC1, cv::Scalar(1))}) {
    EXPECT_FALSE(detector.detect(image, 0.0));
    EXPECT_EQ(detector.trace().outcome, RejectReason::kBadImage);
    EXPECT_FALSE(detector.trace().detail.empty());
  }
}

TEST(WindowDetector, AGreyImageHasOneAnswerWhateverItsEncoding) {
  test::DrawnWindow drawn;
  drawn.opening = test::rectangle(240, 160, 400, 290), drawn.frame_px = 10;
  cv::Mat grey, as_colours;
  cv::cvtColor(drawn.draw(), grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(grey, as_colours, cv::COLOR_GRAY2BGR);
  for (const cv::Mat& reference : {grey, as_colours}) {
    WindowDetector detector{DetectorParams()};
    detector.setReference(ReferenceAppearance(reference, drawn.opening));
    for (const cv::Mat& image : {grey, as_colours}) {
      const auto window = detector.detect(image, 0.0);
      ASSERT_TRUE(window) << detector.trace().detail;
      EXPECT_LT(test::worstCorner(window->corners, drawn.opening), 1.0);
    }
  }
}

TEST(WindowDetector, PlainImagesHoldNoWindow) {
  WindowDetector detector{DetectorParams()};
  for (int value : {0, 128, 255})
    for (int side : {16, 17, 64, 640}) {
      EXPECT_FALSE(detector.detect(cv::Mat(side, side, CV_8UC3, cv::Scalar::all(value)), 0.0));
      EXPECT_EQ(detector.trace().outcome, RejectReason::kNoCandidate);
    }
}

TEST(WindowDetector, RefusesBadParameters) {
  DetectorParams params;
  params.min_score = std::nan("");
  params.gates.min_aspect = -1.0;
  try {
    WindowDetector detector(params);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("min_score"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("gates/min_aspect"), std::string::npos);
  }
}

/// Lists names and values of all fields.
struct Listing {
  std::ostringstream text;
  std::string prefix;
  template <typename Value, typename... Range>
  void operator()(const std::string& name, const Value& value, Range...) {
    text << prefix << name << " " << value << "\n";
  }
  template <typename Params>
  void group(const std::string& name, const Params& params) {
    prefix = name + "/";
    Params::visit(params, *this);
    prefix.clear();
  }
};

std::string listed(const DetectorParams& params) {
  Listing listing;
  DetectorParams::visit(params, listing);
  return listing.text.str();
}

TEST(DetectorParams, TheShippedFileHoldsEveryFieldAtItsDefault) {
  const std::string file = std::string(WINDOW_INGRESS_SOURCE_DIR) + "/config/detector.yaml";
  configuration::DetectorNodeParams params;
  parameters::readYamlFile(file, params);
  EXPECT_EQ(listed(params.detector), listed(DetectorParams()));
  std::ifstream stream(file);
  const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  std::istringstream names(listed(params.detector));
  for (std::string name, value; names >> name >> value;)
    EXPECT_NE(text.find(" " + name.substr(name.find('/') + 1) + ":"), std::string::npos) << name;
}

}  // namespace window_ingress::detection::window_detector_test
