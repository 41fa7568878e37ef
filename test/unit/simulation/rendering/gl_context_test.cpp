#include "simulation/rendering/gl_context.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "../view.hpp"
#include "simulation/scenario/scenario.hpp"

namespace window_ingress::simulation::gl_context_test {

TEST(GlContext, AnotherThreadTakesOver) {
  const Scene scene = buildScene(Scenario());
  Renderer renderer(scene, geometry::PinholeCamera::fromFieldOfView(160, 120, 1.2));
  cv::Mat here, there;
  renderer.render(views::lookAt({-4, 1, 0}, {0, 0, 0}), here);
  std::thread([&] { renderer.render(views::lookAt({-4, 1, 0}, {0, 0, 0}), there); }).join();
  EXPECT_EQ(cv::norm(here, there, cv::NORM_INF), 0.0);
}

#ifdef WINDOW_INGRESS_WITH_OSMESA_AND_EGL
void expectTheSame(const Scene& scene, Antialiasing antialiasing) {
  const auto camera = geometry::PinholeCamera::fromFieldOfView(320, 240, 1.2);
  Renderer by_osmesa(scene, camera, antialiasing, makeOsmesaContext());
  Renderer by_egl(scene, camera, antialiasing, makeEglContext());
  cv::Mat osmesa, egl;
  for (const Eigen::Vector3d& from :
       {Eigen::Vector3d(-6, -2, 0.4), Eigen::Vector3d(-3, 0.5, 0.0), Eigen::Vector3d(-0.8, 0.1, -0.1)}) {
    const Eigen::Isometry3d T_camera_window = views::lookAt(from, {0, 0, 0});
    by_osmesa.render(T_camera_window, osmesa);
    by_egl.render(T_camera_window, egl);
    EXPECT_EQ(cv::norm(osmesa, egl, cv::NORM_INF), 0.0) << "from " << from.transpose();
  }
}

TEST(GlContext, OsmesaAndEglDrawTheSameOfEveryShippedScenario) {
  const std::string folder = std::string(WINDOW_INGRESS_SOURCE_DIR) + "/config/scenarios";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path().filename().string());
    expectTheSame(buildScene(loadScenario(entry.path().string(), 1)), Antialiasing::kEdges);
  }
}

TEST(GlContext, OsmesaAndEglDrawTheSameWithMultisampling) {
  expectTheSame(buildScene(Scenario()), Antialiasing::kMultisampling);
}
#else
TEST(GlContext, OsmesaAndEglDrawTheSame) { GTEST_SKIP() << "needs both libosmesa6-dev and libegl-dev"; }
#endif

}  // namespace window_ingress::simulation::gl_context_test
