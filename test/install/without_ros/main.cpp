// The core without ROS: images, odometry and attitude in, velocity out. `Pilot` is what a node of any
// middleware needs from the package: a method for each message that it receives, and one for its timer.
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "window_ingress/estimation/target_estimator.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/navigation/navigator.hpp"
#include "window_ingress/perception/window_perception.hpp"

using namespace window_ingress;

class Pilot {
 public:
  Pilot(const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera)
      : camera_(camera), T_base_camera_(T_base_camera) {}

  void hearOdometry(const navigation::VehicleState& vehicle) {
    target_.addOdometry(vehicle.stamp_sec, vehicle.T_odom_base, vehicle.velocity_odom_mps);
    input_.vehicle = vehicle;
  }

  void hearAttitude(double stamp_sec, const Eigen::Quaterniond& R_odom_base) {
    target_.addAttitude(stamp_sec, R_odom_base);
  }

  void hearImage(double stamp_sec, const cv::Mat& image) {
    detection::TrackInput frame;
    frame.image = image;
    frame.stamp_sec = stamp_sec;
    frame.camera = &camera_;
    const auto window = perception_.update(frame);
    target_.addDetection({stamp_sec, camera_, T_base_camera_, window, perception_.windows()});
    input_.image_stamp_sec = stamp_sec;
  }

  Reply start(double now_sec) { return navigator_.start(input_, now_sec); }

  navigation::NavigatorOutput step(double now_sec) {
    input_.target = target_.target(now_sec);
    const auto output = navigator_.step(input_, now_sec);
    target_.addNavigatorState(output.report.window_id, output.report.given_up, output.report.next_window);
    return output;
  }

 private:
  geometry::PinholeCamera camera_;
  Eigen::Isometry3d T_base_camera_;
  perception::WindowPerception perception_{detection::DetectorParams(), openness::InteriorKltParams()};
  estimation::TargetEstimator target_{estimation::PoseParams(), estimation::FilterParams(),
                                      estimation::TargetEstimatorParams()};
  navigation::Navigator navigator_{navigation::NavigatorParams()};
  navigation::NavigatorInput input_;
};

// Replaces a camera: a wall with a framed opening.
cv::Mat draw(const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_camera_window) {
  cv::Mat image(camera.height, camera.width, CV_8UC3, cv::Scalar(150, 165, 175));
  const auto fill = [&](double width_m, double height_m, const cv::Scalar& colour) {
    constexpr int kBits = 8;  // fraction bits of a pixel
    const auto seen = geometry::projectOpening(camera, T_camera_window, {width_m, height_m});
    std::vector<cv::Point> corners;
    for (const auto& p : seen.value())
      corners.emplace_back(cvRound(p.x() * (1 << kBits)), cvRound(p.y() * (1 << kBits)));
    cv::fillConvexPoly(image, corners, colour, cv::LINE_AA, kBits);
  };
  fill(1.4, 1.2, {50, 140, 215});
  fill(1.2, 1.0, {60, 55, 50});
  return image;
}

int main() {
  constexpr double kPeriod_sec = 1.0 / 30.0, kEnd_sec = 6.0;
  const auto camera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);
  const Eigen::Isometry3d T_base_camera =
      geometry::makePose(geometry::R_optical_flu().transpose(), Eigen::Vector3d::Zero());
  const Eigen::Isometry3d T_odom_window = geometry::makePose(Eigen::Matrix3d::Identity(), {5.0, 0.0, 1.5});
  Pilot pilot(camera, T_base_camera);
  navigation::VehicleState vehicle;
  vehicle.T_odom_base.translation() = Eigen::Vector3d(0.0, 0.6, 1.4);
  navigation::NavigatorOutput output;
  for (double now_sec = kPeriod_sec; now_sec < kEnd_sec; now_sec += kPeriod_sec) {
    vehicle.stamp_sec = now_sec;
    pilot.hearAttitude(now_sec, Eigen::Quaterniond(vehicle.T_odom_base.linear()));
    pilot.hearOdometry(vehicle);
    pilot.hearImage(now_sec, draw(camera, (vehicle.T_odom_base * T_base_camera).inverse() * T_odom_window));
    if (output.state == navigation::State::kIdle) pilot.start(now_sec);
    output = pilot.step(now_sec);
    // Replaces an autopilot: the vehicle follows each setpoint at once.
    vehicle.velocity_odom_mps = output.setpoint.velocity_odom_mps;
    vehicle.T_odom_base.translation() += vehicle.velocity_odom_mps * kPeriod_sec;
    vehicle.T_odom_base.linear() *= geometry::yawRotation(output.setpoint.yaw_rate_radps * kPeriod_sec);
  }
  std::printf("%s, %.2f m before the window, %.2f m to the left of its axis\n", toString(output.state),
              output.report.distance_m, output.report.lateral_m);
  return output.report.has_relative && output.report.distance_m < 4.0 ? 0 : 1;
}
