#include <algorithm>
#include <array>
#include <cmath>

#include "evaluation/openness/openness_approach.hpp"

namespace window_ingress::evaluation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using simulation::RandomStream;

constexpr double kGrowth = 1.25, kOldest_sec = 4.0, kShared = 0.4, kMargin = 0.07;
constexpr double kBoard_m = 0.02;     // behind the border
constexpr double kDirty = 0.05;       // of the points on a pane of glass
constexpr double kWrongWay_px = 4.0;  // of a wrongly tracked point

/// The scene within the border, in the window's axes.
class Surfaces {
 public:
  Surfaces(Interior interior, const geometry::OpeningSize& opening, double reflectivity, RandomStream& random)
      : interior_(interior), opening_(opening), reflectivity_(reflectivity) {
    behind_m_ = interior == Interior::kPane ? random.uniform(0.0, 0.15) : random.uniform(0.0, 0.24);
    wave_rad_m_ = random.uniform(15.0, 40.0);
    sway_m_ = random.uniform(0.0, 0.05), sway_rate_ = random.uniform(1.0, 6.0);
    tilt_ = random.uniform(-0.3, 0.3);
    side_ = random.uniformInt(0, 3);
    is_board_plain_ = random.uniform(0.0, 1.0) < 0.5;
    depth_m_ = random.uniform(1.0, 6.0);
    half_width_m_ = random.uniform(1.0, 3.0);
    for (auto& thing : things_)
      thing = {random.uniform(0.4, 1.0) * depth_m_, random.uniform(-1.5, 1.0), random.uniform(0.3, 1.2),
               random.uniform(-1.5, -0.3), random.uniform(0.4, 1.5)};
  }

  double roomM() const { return depth_m_; }

  /// Point hit by a line of sight through the border's plane; nothing if there is no texture.
  std::optional<Vector3d> meet(const Vector3d& eye, const Vector3d& front, RandomStream& random) const {
    const Vector3d way = (front - eye) / (front.x() - eye.x());  // one metre deep
    const auto at = [&](double depth_m) { return Vector3d(front + depth_m * way); };
    switch (interior_) {
      case Interior::kPoster:
      case Interior::kDirt:
      case Interior::kJump:
        return front;
      case Interior::kPane:
      case Interior::kCurtain:
        return at(behind_m_);
      case Interior::kTilted:
        return at(std::max(0.0, 0.15 + tilt_ * front.y() / opening_.width_m));
      case Interior::kMirror:
        return at(random.uniform(2.0, 40.0));
      case Interior::kGlass:
        if (random.uniform(0.0, 1.0) < kDirty) return front;
        return random.uniform(0.0, 1.0) < reflectivity_ ? at(random.uniform(2.0, 40.0)) : room(front, way);
      case Interior::kPartly:
        if (!onBoard(front)) return room(front, way);
        return is_board_plain_ ? std::nullopt : std::optional(at(kBoard_m));
      case Interior::kRoom:
        return room(front, way);
    }
    return std::nullopt;
  }

  /// True if the line of sight through the border's plane does not end at a board.
  bool isFree(const Vector3d& front) const { return interior_ != Interior::kPartly || !onBoard(front); }

  /// The point after its motion up to this time.
  Vector3d moved(const Vector3d& point, double time_sec) const {
    if (interior_ != Interior::kCurtain) return point;
    const double fold = wave_rad_m_ * point.y(), swing = std::sin(sway_rate_ * time_sec + 0.1 * fold);
    return point + Vector3d(0.03 * std::sin(fold) + sway_m_ * swing, sway_m_ * swing, 0.0);
  }

 private:
  struct Thing {
    double depth_m, y_m, width_m, z_m, height_m;
  };

  bool onBoard(const Vector3d& front) const {
    const std::array<double, 4> into{front.y(), -front.y(), front.z(), -front.z()};
    return into[side_] > 0.0;
  }

  std::optional<Vector3d> room(const Vector3d& front, const Vector3d& way) const {
    double nearest_m = depth_m_;
    const auto wall = [&](int axis, double place) {
      const double depth_m = (place - front[axis]) / way[axis];
      if (depth_m > 0.0) nearest_m = std::min(nearest_m, depth_m);
    };
    wall(1, half_width_m_), wall(1, -half_width_m_), wall(2, -1.5), wall(2, 1.1);
    for (const Thing& thing : things_) {
      const Vector3d p = front + thing.depth_m * way;
      if (std::abs(p.y() - thing.y_m) < 0.5 * thing.width_m && p.z() > thing.z_m &&
          p.z() < thing.z_m + thing.height_m)
        nearest_m = std::min(nearest_m, thing.depth_m);
    }
    return Vector3d(front + nearest_m * way);
  }

  Interior interior_;
  geometry::OpeningSize opening_;
  double reflectivity_, behind_m_, wave_rad_m_, sway_m_, sway_rate_, tilt_, depth_m_, half_width_m_;
  int side_;
  bool is_board_plain_;
  std::array<Thing, 4> things_;
};

/// Points within the border as a tracker would deliver them.
class SyntheticFollower {
 public:
  SyntheticFollower(Interior interior, const OpennessRange& range, const geometry::OpeningSize& opening,
                    const geometry::PinholeCamera& camera, std::uint32_t seed)
      : interior_(interior),
        range_(range),
        opening_(opening),
        camera_(camera),
        random_(seed, "synthetic interior"),
        surfaces_(interior, opening, range.reflectivity, random_),
        count_(random_.uniformInt(12, 60)),
        wrong_part_(random_.uniform(0.0, 0.1)) {}

  double roomM() const { return surfaces_.roomM(); }

  void follow(const Eigen::Isometry3d& T_window_camera, detection::WindowObservation& window) {
    if (key_side_px_ > 0.0) report(T_window_camera, window);
    const double side_px = std::sqrt(geometry::signedArea(window.corners));
    const bool worn_out = side_px > kGrowth * key_side_px_ ||
                          window.stamp_sec - tracks_.key_stamp_sec > kOldest_sec ||
                          window.interior.points.size() < kShared * static_cast<double>(points_.size());
    if (worn_out) takeKey(T_window_camera, window, side_px);
  }

 private:
  struct Point {
    Vector3d place;
    Vector2d key_px, error_px, wrong_way_px;
    bool lost = false;
  };

  Vector2d noise(double sigma) {
    const double x = random_.normal(sigma);
    return {x, random_.normal(sigma)};
  }

  void takeKey(const Eigen::Isometry3d& T_window_camera, const detection::WindowObservation& window,
               double side_px) {
    key_side_px_ = side_px;
    tracks_.key_stamp_sec = window.stamp_sec;
    tracks_.key_corners = window.corners;
    tracks_.key_covariance = window.corner_covariance;
    points_.clear();
    const double half = 0.5 - kMargin;
    for (int i = 0; i < count_; ++i) {
      const Vector3d front(0.0, random_.uniform(-half, half) * opening_.width_m,
                           random_.uniform(-half, half) * opening_.height_m);
      const auto place = surfaces_.meet(T_window_camera.translation(), front, random_);
      if (!place) continue;
      const auto key_px = pixelOf(T_window_camera, *place, window.stamp_sec);
      if (!key_px) continue;
      const bool is_wrong = random_.uniform(0.0, 1.0) < wrong_part_;
      points_.push_back(
          {*place, *key_px, noise(range_.flow_noise_px), is_wrong ? noise(kWrongWay_px) : Vector2d(0, 0)});
    }
  }

  std::optional<Vector2d> pixelOf(const Eigen::Isometry3d& T_window_camera, const Vector3d& place,
                                  double stamp_sec) const {
    return camera_.project(T_window_camera.inverse() * surfaces_.moved(place, stamp_sec));
  }

  static Vector3d crossing(const Vector3d& eye, const Vector3d& place) {
    return eye - eye.x() / (place.x() - eye.x()) * (place - eye);
  }

  void report(const Eigen::Isometry3d& T_window_camera, detection::WindowObservation& window) {
    window.interior = tracks_;
    window.interior.sigma_px = range_.flow_noise_px * std::sqrt(2.0);
    const double age_sec = window.stamp_sec - tracks_.key_stamp_sec;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      Point& point = points_[i];
      auto now_px = pixelOf(T_window_camera, point.place, window.stamp_sec);
      if (interior_ == Interior::kDirt) now_px = point.key_px;
      if (!now_px || point.lost) continue;
      *now_px += point.error_px + noise(range_.flow_noise_px) + age_sec * point.wrong_way_px;
      point.lost = !geometry::contains(window.corners, *now_px) ||
                   (point.place.x() > kBoard_m &&
                    !surfaces_.isFree(crossing(T_window_camera.translation(), point.place)));
      if (point.lost) continue;
      window.interior.points.push_back(
          {static_cast<std::uint16_t>(i), point.key_px, *now_px, Vector2d::Zero(), 0});
    }
  }

  Interior interior_;
  const OpennessRange& range_;
  geometry::OpeningSize opening_;
  const geometry::PinholeCamera& camera_;
  RandomStream random_;
  Surfaces surfaces_;
  int count_;
  double wrong_part_, key_side_px_ = 0.0;  ///< 0: no keyframe yet
  detection::InteriorTracks tracks_;
  std::vector<Point> points_;
};

}  // namespace

const char* toString(Interior interior) {
  static constexpr std::array<const char*, kInteriors> kNames{"poster", "pane", "curtain", "tilted", "partly",
                                                              "dirt",   "jump", "mirror",  "glass",  "room"};
  return kNames[static_cast<int>(interior)];
}

OpennessResult flySynthetic(Interior interior, std::uint32_t seed, const OpennessRange& range,
                            const openness::OpennessParams& params, const OpennessStep& each) {
  RandomStream random(seed, "synthetic opening");
  const geometry::OpeningSize opening{random.uniform(0.8, 1.8), random.uniform(0.7, 1.4)};
  const auto camera = geometry::PinholeCamera::fromFieldOfView(640, 480, random.uniform(1.0, 1.5));
  OpennessApproach approach(range, opening, params, seed);
  SyntheticFollower follower(interior, range, opening, camera, seed);
  const double jump_at = random.uniform(0.1, 0.9), grown = random.uniform(0.03, 0.2);
  OpennessResult result;
  result.kind = toString(interior);
  result.is_open = interior == Interior::kRoom;
  result.room_m = result.is_open ? follower.roomM() : 0.0;
  result.seed = seed;
  for (int i = 0; i < approach.steps(); ++i) {
    const bool jumped = interior == Interior::kJump && i > jump_at * approach.steps();
    auto window = approach.look(camera, i, jumped ? grown : 0.0);
    if (window) {
      follower.follow(approach.motion(i).T_window_camera, *window);
      approach.judge(*window, camera, i);
    }
    approach.note(i, result, each);
  }
  return result;
}

}  // namespace window_ingress::evaluation
