#include "evaluation/images/survey_image.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simulation/camera/camera_sensor.hpp"
#include "simulation/camera/reference_image.hpp"
#include "simulation/random_stream.hpp"
#include "simulation/scene/scene.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::evaluation {
namespace {

using Eigen::Vector3d;
using simulation::RandomStream;

constexpr int kViewTries = 20000;
constexpr double kViewHeight_m = 0.4, kTilt_rad = 0.15, kSpeed_mps = 0.25, kTurn_radps = 0.08;
constexpr double kMinHeight_m = 0.3;  // above the ground
constexpr double kInFront_m = 0.004;  // of the border: the line of sight must reach this point
constexpr int kPointsOfSide = 4;

Vector3d spread(RandomStream& random, double sigma) {
  return random.normals(sigma).cwiseMax(-2.0 * sigma).cwiseMin(2.0 * sigma);
}

Vector3d positionOf(const simulation::Vertex& vertex) {
  return {vertex.position[0], vertex.position[1], vertex.position[2]};
}

// Moeller and Trumbore; between the ends of the segment.
bool crosses(const Vector3d& from, const Vector3d& way, const Vector3d& a, const Vector3d& b,
             const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, normal = way.cross(ac);
  const double determinant = ab.dot(normal);
  if (std::abs(determinant) < 1e-12) return false;
  const Vector3d to_from = from - a;
  const double u = to_from.dot(normal) / determinant;
  const Vector3d q = to_from.cross(ab);
  const double v = way.dot(q) / determinant, t = ac.dot(q) / determinant;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < 1.0;
}

bool isFree(const simulation::Mesh& mesh, const Vector3d& eye, const Vector3d& point) {
  const Vector3d way = point - eye;
  for (const auto& [batch, vertices] : mesh.batches())
    for (std::size_t i = 0; i + 3 < vertices.size(); i += 4) {
      const Vector3d a = positionOf(vertices[i]), c = positionOf(vertices[i + 2]);
      if (crosses(eye, way, a, positionOf(vertices[i + 1]), c)) return false;
      if (crosses(eye, way, a, c, positionOf(vertices[i + 3]))) return false;
    }
  return true;
}

SurveyView draw(RandomStream& random, const ViewRange& range, double ground_z_m, double half_fov_rad) {
  SurveyView view;
  view.distance_m = random.uniform(range.nearest_m, range.farthest_m);
  view.off_axis_rad = random.uniform(-range.off_axis_rad, range.off_axis_rad);
  const double height_m = std::max(random.uniform(-kViewHeight_m, kViewHeight_m), ground_z_m + kMinHeight_m);
  const Vector3d eye(-view.distance_m * std::cos(view.off_axis_rad),
                     view.distance_m * std::sin(view.off_axis_rad), height_m);
  const double heading_rad = random.uniform(-half_fov_rad, half_fov_rad) - view.off_axis_rad;
  const double pitch_rad = random.uniform(-kTilt_rad, kTilt_rad);
  const double roll_rad = random.uniform(-kTilt_rad, kTilt_rad);
  const Eigen::Matrix3d look = geometry::yawRotation(heading_rad) *
                               Eigen::AngleAxisd(pitch_rad, Vector3d::UnitY()).toRotationMatrix() *
                               Eigen::AngleAxisd(roll_rad, Vector3d::UnitX()).toRotationMatrix();
  view.motion.T_window_camera = geometry::makePose(look * geometry::R_optical_flu().transpose(), eye);
  const Vector3d velocity = spread(random, kSpeed_mps), turn = spread(random, kTurn_radps);
  if (!range.still) view.motion.velocity_window_mps = velocity;
  if (!range.still) view.motion.angular_velocity_camera_radps = turn;
  return view;
}

bool showsWhole(const geometry::PinholeCamera& camera, const std::optional<geometry::Quadrilateral>& quad,
                double margin_px) {
  return quad && std::all_of(quad->begin(), quad->end(), [&](const Eigen::Vector2d& corner) {
           return camera.contains(corner, margin_px);
         });
}

constexpr double kSettling = 60.0;  // time constants of the automatic gains between two images

// The gains follow the previous image: after a long time between two images they have settled.
cv::Mat expose(const simulation::Scenario& scenario, const simulation::Scene& scene,
               const simulation::CameraTruth& motion, std::uint32_t seed) {
  simulation::CameraSensor sensor(scene, scenario.camera, seed);
  const bool automatic = scenario.camera.auto_exposure || scenario.camera.auto_white_balance;
  if (automatic) sensor.expose(motion, 0, 0.0);
  return sensor.expose(motion, 1, kSettling * scenario.camera.auto_exposure_sec).clone();
}

}  // namespace

bool borderIsFree(const simulation::Mesh& mesh, const Vector3d& eye, const geometry::OpeningSize& opening) {
  const auto corners = geometry::openingCorners(opening);
  for (int side = 0; side < 4; ++side)
    for (int k = 0; k < kPointsOfSide; ++k) {
      const double part = static_cast<double>(k) / kPointsOfSide;
      Vector3d point = (1.0 - part) * corners[side] + part * corners[(side + 1) % 4];
      point.x() -= kInFront_m;
      if (!isFree(mesh, eye, point)) return false;
    }
  return true;
}

std::optional<geometry::Quadrilateral> projectMoving(const geometry::PinholeCamera& camera,
                                                     const simulation::CameraTruth& motion,
                                                     double readout_sec, const geometry::OpeningSize& size,
                                                     double behind_m) {
  const auto corners = geometry::openingCorners(size);
  geometry::Quadrilateral quad;
  for (int i = 0; i < 4; ++i) {
    const Vector3d corner = corners[i] + behind_m * Vector3d::UnitX();
    double after_sec = 0.0;
    for (int pass = 0; pass < 4; ++pass) {
      const auto pixel = camera.project(motion.T_camera_window(after_sec) * corner);
      if (!pixel) return std::nullopt;
      quad[i] = *pixel;
      after_sec = ((pixel->y() + 0.5) / camera.height - 0.5) * readout_sec;
    }
  }
  return quad;
}

SurveyView drawView(const simulation::Scenario& scenario, const simulation::Scene& scene,
                    const geometry::PinholeCamera& camera, const ViewRange& range, std::uint32_t seed) {
  RandomStream random(seed, "survey view");
  const double half_fov_rad = std::atan(0.5 * camera.width / camera.fx);
  for (int i = 0; i < kViewTries; ++i) {
    const SurveyView view = draw(random, range, scene.ground_z_m, half_fov_rad);
    const auto quad =
        projectMoving(camera, view.motion, scenario.camera.readout_sec, scenario.opening(), 0.0);
    if (!showsWhole(camera, quad, range.margin_px)) continue;
    if (borderIsFree(scene.mesh, view.motion.T_window_camera.translation(), scenario.opening())) return view;
  }
  throw std::runtime_error("no view of the whole window found; is it too large for the distance?");
}

std::optional<SurveyTruth> surveyTruth(const simulation::Scenario& scenario, const simulation::Scene& scene,
                                       const geometry::PinholeCamera& camera,
                                       const simulation::CameraTruth& motion) {
  const auto project = [&](const geometry::OpeningSize& size, double behind_m) {
    return projectMoving(camera, motion, scenario.camera.readout_sec, size, behind_m);
  };
  const geometry::OpeningSize opening = scenario.opening();
  const double frame_m = scenario.window.frame_width_m;
  const auto inner = project(opening, 0.0);
  if (!inner) return std::nullopt;
  SurveyTruth truth;
  truth.present = scenario.window.present;
  truth.inner = *inner;
  truth.far = project(opening, scene.opening_depth_m).value_or(*inner);
  if (frame_m > 0.0)
    truth.outer = project({opening.width_m + 2.0 * frame_m, opening.height_m + 2.0 * frame_m}, 0.0);
  return truth;
}

SurveyImage takeImage(const simulation::Scenario& scenario, std::uint32_t seed, const ViewRange& range,
                      bool with_reference) {
  const simulation::Scene scene = simulation::buildScene(scenario);
  SurveyImage sample;
  sample.seed = seed;
  sample.camera = scenario.camera.model();
  const SurveyView view = drawView(scenario, scene, sample.camera, range, seed);
  sample.distance_m = view.distance_m;
  sample.off_axis_rad = view.off_axis_rad;
  sample.truth = *surveyTruth(scenario, scene, sample.camera, view.motion);
  sample.image = expose(scenario, scene, view.motion, seed);
  if (with_reference) sample.reference = simulation::referenceImage(scenario, &sample.reference_corners);
  return sample;
}

}  // namespace window_ingress::evaluation
