#include "simulation/scene/scene.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "simulation/camera/lens.hpp"

namespace window_ingress::simulation::scene_test {

bool isFree(const Scene& scene, const Eigen::Vector3d& position, const Eigen::Vector3d& half_extents) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = position;
  for (const auto& obstacle : scene.obstacles)
    if (touches(pose, half_extents, obstacle.box)) return false;
  return true;
}

TEST(Scene, TheWayThroughTheOpeningIsFreeUpToItsBorders) {
  const Scenario scenario;
  const Scene scene = buildScene(scenario);
  const Eigen::Vector3d plug(0.1, 0.5 * scenario.window.width_m - 1e-6,
                             0.5 * scenario.window.height_m - 1e-6);
  for (double x = -3.0; x < 2.5; x += 0.05) EXPECT_TRUE(isFree(scene, {x, 0, 0}, plug)) << x;
  for (const Eigen::Vector3d& aside : {Eigen::Vector3d(0.1, 0.001, 0), Eigen::Vector3d(0.1, -0.001, 0),
                                       Eigen::Vector3d(0.1, 0, 0.001), Eigen::Vector3d(0.1, 0, -0.001)})
    EXPECT_FALSE(isFree(scene, aside, plug)) << aside.transpose();
}

TEST(Scene, WithoutAWindowTheWallIsClosedAndDecoysAreAlways) {
  Scenario scenario;
  scenario.decoys.emplace_back();
  const Eigen::Vector3d small(0.1, 0.1, 0.1);
  const Eigen::Vector3d decoy(0.0, scenario.decoys[0].y_m, scenario.decoys[0].z_m);
  EXPECT_FALSE(isFree(buildScene(scenario), decoy, small));
  EXPECT_TRUE(isFree(buildScene(scenario), {0.1, 0, 0}, small));
  scenario.window.present = false;
  EXPECT_FALSE(isFree(buildScene(scenario), {0.1, 0, 0}, small));
}

TEST(Scene, LightFallsOnFacesTowardsTheSun) {
  const Lighting light{Eigen::Vector3d(-1, 0, 1).normalized(), 0.5, 0.4};
  const auto red = [&](const Eigen::Vector3d& normal) { return light.brightness(normal, true).x(); };
  EXPECT_GT(red(-Eigen::Vector3d::UnitX()), red(Eigen::Vector3d::UnitX()) + 0.3);
  EXPECT_NEAR(red(Eigen::Vector3d::UnitX()), 0.4, 1e-12);
}

TEST(Mesh, FacesOfABoxLookOutwards) {
  Mesh mesh({Eigen::Vector3d::UnitZ(), 0.0, 1.0});
  const Eigen::AlignedBox3d box(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(2, 4, 6));
  mesh.addBox(box, {});
  const auto& vertices = mesh.batches().at({false, Texture::kPlain});
  ASSERT_EQ(vertices.size(), 24u);
  const auto at = [&](std::size_t i) {
    const auto& p = vertices[i].position;
    return Eigen::Vector3d(p[0], p[1], p[2]);
  };
  for (std::size_t face = 0; face < 24; face += 4) {
    const Eigen::Vector3d normal = (at(face + 1) - at(face)).cross(at(face + 3) - at(face));
    EXPECT_GT(normal.dot(0.5 * (at(face) + at(face + 2)) - box.center()), 0.0) << "face " << face / 4;
    for (std::size_t i = face; i < face + 4; ++i) EXPECT_TRUE(box.contains(at(i)));
  }
}

TEST(Lens, WithoutDistortionItSharesTheImageAndWithItSeesWider) {
  geometry::PinholeCamera camera = geometry::PinholeCamera::fromFieldOfView(64, 48, 1.2);
  cv::Mat image(48, 64, CV_8UC3, cv::Scalar(1, 2, 3)), same;
  Lens(camera).distort(image, same);
  EXPECT_EQ(same.data, image.data);
  camera.distortion[0] = -0.2;
  EXPECT_GT(Lens(camera).idealSize().width, 64);
  camera.distortion[0] = -5.0;
  EXPECT_THROW(Lens{camera}, std::invalid_argument);
}

geometry::PinholeCamera fisheye(double horizontal_fov_rad) {
  geometry::PinholeCamera camera = geometry::PinholeCamera::fromFieldOfView(64, 48, 1.2);
  camera.model = geometry::LensModel::kEquidistant;
  camera.fx = camera.fy = camera.width / horizontal_fov_rad;
  return camera;
}

TEST(Lens, AFisheyeTakesOnePlaneWhereThatIsEnoughAndFacesOfACubeBeyond) {
  EXPECT_EQ(Lens(fisheye(1.68)).planes().size(), 1u);
  geometry::PinholeCamera low = fisheye(2.4);
  low.height = 16;
  low.cy = 7.5;
  EXPECT_EQ(Lens(low).planes().size(), 3u) << "nothing that is nearer to straight up or down than to ahead";
  const Lens wide(fisheye(2.618));
  ASSERT_EQ(wide.planes().size(), 5u);
  int rows = 0;
  for (const IdealPlane& plane : wide.planes()) {
    EXPECT_EQ(plane.part, cv::Rect(0, rows, plane.camera.width, plane.camera.height));
    EXPECT_FALSE(plane.camera.hasDistortion());
    rows += plane.part.height;
  }
  EXPECT_EQ(wide.idealSize().height, rows);
}

TEST(Lens, BeyondOneAndAHalfRadiansAFisheyeIsBlack) {
  const geometry::PinholeCamera camera = fisheye(2.618);
  const Lens lens(camera);
  cv::Mat image;
  lens.distort(cv::Mat(lens.idealSize(), CV_8UC3, cv::Scalar::all(200)), image);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      const double off_rad = std::hypot(u - camera.cx, v - camera.cy) / camera.fx;
      if (std::abs(off_rad - 1.5) < 0.01) continue;
      EXPECT_EQ(image.at<cv::Vec3b>(v, u)[1], off_rad < 1.5 ? 200 : 0) << u << " " << v;
    }
}

}  // namespace window_ingress::simulation::scene_test
