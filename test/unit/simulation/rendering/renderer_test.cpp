#include "simulation/rendering/renderer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "../edge_fit.hpp"
#include "simulation/camera/camera_sensor.hpp"
#include "simulation/camera/lens.hpp"
#include "simulation/random_stream.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::simulation::renderer_test {

using geometry::PinholeCamera;

// The shipped house, with colours that make the frame's inner border the only clear edge: a broad white frame
// in front of a black room.
Scene whiteFrameBeforeBlackRoom(Scenario& scenario) {
  scenario.window.frame = scenario.house.wall = {255, 255, 255};
  scenario.window.reveal = {0, 0, 0};
  scenario.window.frame_width_m = 0.25;
  scenario.house.room_light = 0.0;
  return buildScene(scenario);
}

// Pose of a camera that looks at the opening from a distance, with small additional rotations.
Eigen::Isometry3d lookingFrom(double distance_m, double azimuth_rad, double up_m,
                              const Eigen::Vector3d& turn_rad) {
  const Eigen::Vector3d position(-distance_m * std::cos(azimuth_rad), distance_m * std::sin(azimuth_rad),
                                 up_m);
  const Eigen::Matrix3d turned =
      geometry::yawRotation(turn_rad.z() - azimuth_rad) *
      Eigen::AngleAxisd(turn_rad.y(), Eigen::Vector3d::UnitY()).toRotationMatrix() *
      Eigen::AngleAxisd(turn_rad.x(), Eigen::Vector3d::UnitX()).toRotationMatrix();
  return geometry::makePose(turned * geometry::R_optical_flu().transpose(), position).inverse();
}

struct Errors {
  double worst_px = 0.0, sum_of_squares = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int corners = 0;
};

// Differences between measured and projected corners over random views.
Errors compareCorners(const PinholeCamera& camera, int views,
                      Antialiasing antialiasing = Antialiasing::kEdges) {
  Scenario scenario;
  const Scene scene = whiteFrameBeforeBlackRoom(scenario);
  const Lens lens(camera);
  Renderer renderer(scene, lens.planes().front().camera, antialiasing);
  RandomStream random(11, "views");
  PinholeCamera straight = camera;
  straight.distortion = {};
  Errors errors;
  cv::Mat ideal, image, grey;
  for (int view = 0; view < views; ++view) {
    // One statement each: compilers may evaluate arguments in any order.
    Eigen::Vector3d turn;
    turn.z() = random.uniform(-0.08, 0.08), turn.y() = random.uniform(-0.08, 0.08);
    turn.x() = random.uniform(-0.1, 0.1);
    const double up_m = random.uniform(-0.6, 0.8), azimuth_rad = random.uniform(-0.6, 0.6);
    const auto T_camera_window = lookingFrom(random.uniform(2.2, 8.0), azimuth_rad, up_m, turn);
    renderer.render(T_camera_window, ideal);
    lens.distort(ideal, image);
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    const auto bent = geometry::projectOpening(camera, T_camera_window, scenario.opening());
    const auto expected = geometry::projectOpening(straight, T_camera_window, scenario.opening());
    const auto measured =
        test::fitCorners(grey, *bent, 5, [&](const Eigen::Vector2d& p) { return camera.undistort(p); });
    EXPECT_TRUE(measured) << "view " << view;
    if (!measured) continue;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d error = (*measured)[i] - (*expected)[i];
      errors.worst_px = std::max(errors.worst_px, error.norm());
      errors.sum_of_squares += error.squaredNorm();
      errors.sum += error;
      ++errors.corners;
    }
  }
  return errors;
}

void expectSmall(const Errors& errors) {
  const double rms_px = std::sqrt(errors.sum_of_squares / errors.corners);
  const Eigen::Vector2d mean_px = errors.sum / errors.corners;
  testing::Test::RecordProperty("rms_px", std::to_string(rms_px));
  std::cout << "corner error: rms " << rms_px << " px, worst " << errors.worst_px << " px, mean "
            << mean_px.transpose() << " px\n";
  EXPECT_LT(rms_px, 0.05);
  EXPECT_LT(errors.worst_px, 0.1);
  EXPECT_LT(mean_px.norm(), 0.02);
}

TEST(Renderer, RenderedCornersEqualProjectedCorners) {
  expectSmall(compareCorners(PinholeCamera::fromFieldOfView(640, 480, 1.2), 40));
}

TEST(Renderer, RenderedCornersEqualProjectedCornersWithOffCentreIntrinsics) {
  PinholeCamera camera = PinholeCamera::fromFieldOfView(640, 480, 1.2);
  camera.fx *= 1.05;
  camera.cx += 13.3;
  camera.cy -= 21.7;
  expectSmall(compareCorners(camera, 25));
}

TEST(Renderer, RenderedCornersEqualProjectedCornersThroughALensThatBends) {
  PinholeCamera camera = PinholeCamera::fromFieldOfView(640, 480, 1.2);
  camera.distortion = {-0.22, 0.06, 0.001, -0.0008, 0.002};
  expectSmall(compareCorners(camera, 25));
}

TEST(Renderer, RenderedCornersEqualProjectedCornersWithMultisampling) {
  expectSmall(
      compareCorners(PinholeCamera::fromFieldOfView(640, 480, 1.2), 15, Antialiasing::kMultisampling));
}

// The opening's corners in the image of a lens that bends its sides, in pixels of that image. Each side is
// searched in pieces, which are straight in a plane that faces the opening.
std::optional<geometry::Quadrilateral> fitBentCorners(const cv::Mat& grey, const PinholeCamera& camera,
                                                      const Eigen::Isometry3d& T_camera_window,
                                                      const geometry::OpeningSize& size) {
  constexpr int kPieces = 12;
  const auto corners = geometry::openingCorners(size);
  const Eigen::Quaterniond R =
      Eigen::Quaterniond::FromTwoVectors(T_camera_window.translation(), Eigen::Vector3d::UnitZ());
  std::array<Eigen::Vector3d, 4> lines;
  for (int side = 0; side < 4; ++side) {
    const auto at = [&](int k) {
      const Eigen::Vector3d way = corners[(side + 1) % 4] - corners[side];
      return *camera.project(T_camera_window * (corners[side] + way * (k / double{kPieces})));
    };
    std::vector<Eigen::Vector2d> points;
    for (int k = 1; k + 1 < kPieces; ++k)
      for (const auto& pixel : test::edgePoints(grey, at(k), at(k + 1), 5))
        points.emplace_back((R * camera.ray(pixel)).hnormalized());
    if (points.size() < 10) return std::nullopt;
    lines[side] = test::fitLine(points);
  }
  geometry::Quadrilateral found;
  for (int i = 0; i < 4; ++i) {
    Eigen::Matrix2d normals;
    normals << lines[(i + 3) % 4].head<2>().transpose(), lines[i].head<2>().transpose();
    const Eigen::Vector2d corner = normals.inverse() * Eigen::Vector2d(lines[(i + 3) % 4].z(), lines[i].z());
    found[i] = *camera.project(R.inverse() * corner.homogeneous());
  }
  return found;
}

TEST(Renderer, RenderedCornersEqualProjectedCornersThroughAFisheyeOf150Degrees) {
  CameraParams params;
  params.lens = "equidistant";
  params.horizontal_fov_rad = 2.618;
  params.k1 = -0.01;
  params.noise_grey = params.blur_px = params.exposure_sec = 0.0;
  const PinholeCamera camera = params.model();
  Scenario scenario;
  const Scene scene = whiteFrameBeforeBlackRoom(scenario);
  CameraSensor sensor(scene, params, 1);
  RandomStream random(12, "views");
  Errors errors;
  double furthest_rad = 0.0;
  for (int view = 0; view < 150; ++view) {
    Eigen::Vector3d turn;
    turn.z() = random.uniform(-1.2, 1.2), turn.y() = random.uniform(-0.8, 0.8);
    turn.x() = random.uniform(-0.2, 0.2);
    const double up_m = random.uniform(-0.4, 0.4), azimuth_rad = random.uniform(-0.5, 0.5);
    CameraTruth motion;
    const auto T_camera_window = lookingFrom(random.uniform(0.8, 3.0), azimuth_rad, up_m, turn);
    motion.T_window_camera = T_camera_window.inverse();
    const auto expected = geometry::projectOpening(camera, T_camera_window, scenario.opening());
    if (!expected || !std::all_of(expected->begin(), expected->end(), [&](const Eigen::Vector2d& corner) {
          return camera.contains(corner, 10.0);
        }))
      continue;
    cv::Mat grey;
    cv::cvtColor(sensor.expose(motion, view, 0.0), grey, cv::COLOR_BGR2GRAY);
    const auto measured = fitBentCorners(grey, camera, T_camera_window, scenario.opening());
    if (!measured) continue;  // seen too obliquely
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d error = (*measured)[i] - (*expected)[i];
      errors.worst_px = std::max(errors.worst_px, error.norm());
      errors.sum_of_squares += error.squaredNorm();
      errors.sum += error;
      ++errors.corners;
      furthest_rad = std::max(furthest_rad, std::acos(camera.ray((*expected)[i]).z()));
    }
  }
  std::cout << errors.corners << " corners, up to " << furthest_rad << " rad off the axis\n";
  EXPECT_GT(errors.corners, 200);
  EXPECT_GT(furthest_rad, 1.2);
  expectSmall(errors);
}

// Fraction of pixels in which any channel of two images differs by more than `limit` grey levels.
double differing(const cv::Mat& a, const cv::Mat& b, int limit) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  int count = 0;
  for (int v = 0; v < difference.rows; ++v)
    for (int u = 0; u < difference.cols; ++u) {
      const auto& d = difference.at<cv::Vec3b>(v, u);
      count += std::max({d[0], d[1], d[2]}) > limit;
    }
  return count / static_cast<double>(difference.total());
}

TEST(Renderer, SmoothedEdgesLookAsMultisampledOnes) {
  Scenario scenario;
  scenario.decoys.emplace_back();
  scenario.posters.emplace_back();
  const Scene scene = buildScene(scenario);
  const auto camera = PinholeCamera::fromFieldOfView(640, 480, 1.2);
  Renderer smoothed(scene, camera), multisampled(scene, camera, Antialiasing::kMultisampling);
  RandomStream random(7, "views");
  cv::Mat a, b;
  for (int view = 0; view < 8; ++view) {
    const auto T_camera_window =
        lookingFrom(random.uniform(1.0, 8.0), random.uniform(-1.0, 1.0), random.uniform(-0.5, 0.5),
                    {random.uniform(-0.3, 0.3), 0.0, random.uniform(-0.2, 0.2)});
    smoothed.render(T_camera_window, a);
    multisampled.render(T_camera_window, b);
    EXPECT_LT(differing(a, b, 50), 0.0005) << "four samples are off by up to 1/8 of an edge's contrast";
    EXPECT_LT(cv::norm(a, b, cv::NORM_L1) / static_cast<double>(3 * a.total()), 0.6) << "view " << view;
  }
}

TEST(Renderer, RowsAloneAreThoseOfTheWholeImageAndTheOthersStay) {
  Scenario scenario;
  const Scene scene = buildScene(scenario);
  Renderer renderer(scene, PinholeCamera::fromFieldOfView(160, 120, 1.2));
  const auto T_camera_window = lookingFrom(4.0, 0.3, 0.2, {0.1, 0.0, 0.0});
  cv::Mat whole, part(120, 160, CV_8UC3, cv::Scalar(1, 2, 3));
  renderer.render(T_camera_window, whole);
  renderer.renderRows(T_camera_window, cv::Range(40, 80), part);
  EXPECT_EQ(cv::norm(whole.rowRange(41, 79), part.rowRange(41, 79), cv::NORM_INF), 0.0);
  const cv::Mat above = part.rowRange(0, 40), below = part.rowRange(80, 120);
  EXPECT_EQ(cv::norm(above, cv::Mat(40, 160, CV_8UC3, cv::Scalar(1, 2, 3)), cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(below, cv::Mat(40, 160, CV_8UC3, cv::Scalar(1, 2, 3)), cv::NORM_INF), 0.0);
}

TEST(Renderer, AWindowToTheLeftAppearsLeftAndOneBelowAppearsBelow) {
  Scenario scenario;
  const Scene scene = whiteFrameBeforeBlackRoom(scenario);
  Renderer renderer(scene, PinholeCamera::fromFieldOfView(320, 240, 1.2));
  const auto darkCentre = [&](double y_m, double z_m) {
    const auto T_window_camera = geometry::makePose(geometry::R_optical_flu().transpose(), {-5.0, y_m, z_m});
    cv::Mat image, grey, dark;
    renderer.render(T_window_camera.inverse(), image);
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    cv::threshold(grey, dark, 20, 255, cv::THRESH_BINARY_INV);
    const cv::Moments moments = cv::moments(dark, true);
    return Eigen::Vector2d(moments.m10 / moments.m00, moments.m01 / moments.m00);
  };
  EXPECT_NEAR(darkCentre(0, 0).x(), 159.5, 1.0);
  EXPECT_NEAR(darkCentre(0, 0).y(), 119.5, 1.0);
  EXPECT_LT(darkCentre(-1.0, 0).x(), 130.0) << "the camera stands right of the window";
  EXPECT_GT(darkCentre(1.0, 0).x(), 190.0);
  EXPECT_GT(darkCentre(0, 0.7).y(), 145.0) << "the camera stands above the window";
  EXPECT_LT(darkCentre(0, -0.7).y(), 95.0);
}

TEST(Renderer, SeveralInOneProcessAndInThreadsDrawTheSame) {
  Scenario scenario;
  const Scene scene = buildScene(scenario);
  const auto camera = PinholeCamera::fromFieldOfView(160, 120, 1.2);
  const auto T_camera_window = lookingFrom(4.0, 0.3, 0.2, Eigen::Vector3d::Zero());
  Renderer first(scene, camera), second(scene, PinholeCamera::fromFieldOfView(200, 100, 1.0));
  cv::Mat before, between, after, elsewhere;
  first.render(T_camera_window, before);
  before = before.clone();
  second.render(T_camera_window, between);
  first.render(T_camera_window, after);
  std::thread([&] { Renderer(scene, camera).render(T_camera_window, elsewhere); }).join();
  EXPECT_EQ(cv::norm(before, after, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(before, elsewhere, cv::NORM_INF), 0.0);
  EXPECT_EQ(between.size(), cv::Size(200, 100));
}

TEST(Renderer, RefusesCamerasThatCannotBe) {
  Scenario scenario;
  const Scene scene = buildScene(scenario);
  EXPECT_THROW(Renderer(scene, PinholeCamera()), std::invalid_argument);
  PinholeCamera camera = PinholeCamera::fromFieldOfView(160, 120, 1.2);
  camera.fx = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Renderer(scene, camera), std::invalid_argument);
  camera = PinholeCamera::fromFieldOfView(160, 120, 1.2);
  camera.distortion[0] = -0.1;
  EXPECT_THROW(Renderer(scene, camera), std::invalid_argument);
}

}  // namespace window_ingress::simulation::renderer_test
