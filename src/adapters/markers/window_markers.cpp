#include "adapters/markers/window_markers.hpp"

#include <algorithm>
#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/markers/marker_colours.hpp"
#include "adapters/markers/marker_sketch.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kArrowM = 0.9, kFanM = 0.75;
constexpr double kSigmas = 3.0;
constexpr double kWallM = 1.2;                            // extent beyond the opening's border
constexpr double kNumberAboveM = 0.2, kTextAboveM = 0.7;  // above the opening's upper border
constexpr double kFaintest = 0.5;                         // opacity of the less likely hypothesis
constexpr double kFaceAlpha = 0.2;                        // transparent, but still clickable
constexpr double kFlyableM = 0.3, kFlyableScore = 0.5;    // below: a pane, a paving stone
constexpr int kFanParts = 12;

Points cornersOf(const Eigen::Isometry3d& T, const geometry::OpeningSize& size) {
  Points corners;
  for (const Eigen::Vector3d& corner : geometry::openingCorners(size)) corners.push_back(T * corner);
  return corners;
}

Eigen::Vector3d above(const Eigen::Isometry3d& T, double height_m, double above_m) {
  return T * Eigen::Vector3d(0.0, 0.0, 0.5 * height_m + above_m);
}

Points closed(Points corners) {
  corners.push_back(corners.front());
  return corners;
}

// Fan between the headings `half_angle_rad` to both sides of the window's.
Points fanOf(const Eigen::Isometry3d& T, double half_angle_rad) {
  const auto at = [&](int part) -> Eigen::Vector3d {
    const double angle_rad = half_angle_rad * (2.0 * part / kFanParts - 1.0);
    return T * Eigen::Vector3d(kFanM * std::cos(angle_rad), kFanM * std::sin(angle_rad), 0.0);
  };
  Points triangles;
  for (int part = 0; part < kFanParts; ++part)
    for (const Eigen::Vector3d& corner : {Eigen::Vector3d(T.translation()), at(part), at(part + 1)})
      triangles.push_back(corner);
  return triangles;
}

// Four plates around the opening.
Points wallOf(const Eigen::Isometry3d& T, const geometry::OpeningSize& size) {
  const Points inner = cornersOf(T, size);
  const Points outer = cornersOf(T, {size.width_m + 2.0 * kWallM, size.height_m + 2.0 * kWallM});
  Points triangles;
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    appendFace(triangles, inner[i], inner[next], outer[next], outer[i]);
  }
  return triangles;
}

double yawSpread(const estimation::Matrix6d& covariance) {
  return std::min(kSigmas * std::sqrt(std::max(0.0, covariance(5, 5))), M_PI);
}

struct Look {
  std::string name;
  int rgb;
  double alpha;
};

void drawHypothesis(MarkerSketch& sketch, const Look& look, const Eigen::Isometry3d& T,
                    const estimation::Matrix6d& covariance, const geometry::OpeningSize& size) {
  const auto colour = colourOf(look.rgb, look.alpha), faint = colourOf(look.rgb, 0.35 * look.alpha);
  sketch.line(look.name, closed(cornersOf(T, size)), colour);
  sketch.arrow(look.name + ": way through", T.translation(), T * Eigen::Vector3d(kArrowM, 0.0, 0.0), colour);
  sketch.surface(look.name + ": heading, 3 sigma", fanOf(T, yawSpread(covariance)), faint);
  sketch.ellipsoid(look.name + ": centre, 3 sigma", T.translation(), covariance.topLeftCorner<3, 3>(),
                   kSigmas, faint);
}

void drawNoHypothesis(MarkerSketch& sketch, const std::string& name) {
  for (const char* part : {"", ": way through", ": heading, 3 sigma", ": centre, 3 sigma"})
    sketch.gone(name + part);
}

bool isFoundOut(const window_ingress::KnownWindow& window) {
  return window.openness != window_ingress::Openness::UNKNOWN || window.failures > 0;
}

// A possible target, or a window whose openness is known or at which a flight has failed.
bool isDrawn(const window_ingress::KnownWindow& window) {
  const bool is_candidate = window.may_be_target && window.score >= kFlyableScore &&
                            std::min(window.width, window.height) >= kFlyableM;
  return is_candidate || isFoundOut(window);
}

// The same object under two numbers, or a part of it: only the target or the better score is drawn.
bool isPartOfAnother(const window_ingress::KnownWindow& window, const window_ingress::Facade& facade) {
  const auto hides = [&](const window_ingress::KnownWindow& other) {
    const double radius_m = 0.5 * std::max({window.width, window.height, other.width, other.height});
    const bool counts_more = other.id == facade.target_id || (isDrawn(other) && other.score > window.score);
    return other.id != window.id && counts_more &&
           (toEigen(window.pose.position) - toEigen(other.pose.position)).norm() < radius_m;
  };
  return !isFoundOut(window) && std::any_of(facade.windows.begin(), facade.windows.end(), hides);
}

std::string chances(const estimation::FilteredWindow& window) {
  return formatted("\namber or violet: %.1f : %.1f %%", 100.0 * window.hypothesis_weight,
                   100.0 * (1.0 - window.hypothesis_weight));
}

}  // namespace

geometry_msgs::PolygonStamped openingPolygon(const Eigen::Isometry3d& T_frame_window,
                                             const geometry::OpeningSize& opening, const ros::Time& stamp,
                                             const std::string& frame_id) {
  geometry_msgs::PolygonStamped message;
  message.header = headerOf(stamp, frame_id);
  for (const Eigen::Vector3d& corner : geometry::openingCorners(opening)) {
    const Eigen::Vector3f point = (T_frame_window * corner).cast<float>();
    geometry_msgs::Point32 vertex;
    vertex.x = point.x();
    vertex.y = point.y();
    vertex.z = point.z();
    message.polygon.points.push_back(vertex);
  }
  return message;
}

std::string windowLabel(const window_ingress::WindowPose& message) {
  static const char* const kFits[] = {"vehicle may fit", "vehicle fits", "too small"};
  const window_ingress::RelativeYaw& yaw = message.image.relative_yaw;
  const window_ingress::SystemChecks& checks = message.checks;
  const std::string sight = message.image.reject == window_ingress::ImagePose::OK
                                ? formatted("yaw %+.1f +- %.1f deg", yaw.angle * geometry::kDegreesPerRad,
                                            yaw.sigma * geometry::kDegreesPerRad)
                                : formatted("last seen %.1f s ago", message.filtered.age);
  return sight + formatted("\n%.2f x %.2f m: ", message.size.width, message.size.height) +
         kFits[std::min<int>(checks.fit, 2)] +
         (checks.frames == window_ingress::SystemChecks::FRAMES_WRONG ? "\nframes wrong" : "");
}

visualization_msgs::MarkerArray windowMarkers(const estimation::FilteredWindow& window,
                                              const std::string& text, const ros::Time& stamp,
                                              const std::string& frame_id) {
  MarkerSketch sketch(stamp, frame_id);
  const geometry::OpeningSize& size = window.size.size;
  const int rgb = window.sign_trusted ? kTrustedRgb : kOpenRgb;
  drawHypothesis(sketch, {"window", rgb, 1.0}, window.T_odom_window, window.covariance, size);
  const bool is_open = window.alternative && !window.sign_trusted;
  if (is_open) {
    const double alpha = kFaintest + (1.0 - kFaintest) * (1.0 - window.hypothesis_weight);
    drawHypothesis(sketch, {"mirrored window", kMirroredRgb, alpha}, window.alternative->T_odom_window,
                   window.alternative->covariance, size);
  } else {
    drawNoHypothesis(sketch, "mirrored window");
  }
  if (window.sign_trusted)
    sketch.surface("wall", wallOf(window.T_odom_window, size), colourOf(kWallRgb, 0.45));
  else
    sketch.gone("wall");
  sketch.text("window: text", above(window.T_odom_window, size.height_m, kTextAboveM),
              is_open ? text + chances(window) : text);
  return sketch.markers();
}

visualization_msgs::MarkerArray facadeMarkers(const window_ingress::Facade& facade) {
  static const char* const kVerdicts[] = {"open?", "OPEN", "CLOSED"};
  static const int kColours[] = {kKnownRgb, kTrustedRgb, kClosedRgb};
  MarkerSketch sketch(facade.header.stamp, facade.header.frame_id);
  for (const window_ingress::KnownWindow& window : facade.windows) {
    const auto T = fromMsg(window.pose);
    const bool is_target = window.id == facade.target_id;
    if (!T || !(is_target || (isDrawn(window) && !isPartOfAnother(window, facade)))) continue;
    const std::string name = "window " + std::to_string(window.id);
    const int verdict = std::min<int>(window.openness, 2);
    const Points corners = cornersOf(*T.value, {window.width, window.height});
    if (!is_target) sketch.line(name, closed(corners), colourOf(kColours[verdict], 0.9));
    Points face;
    appendFace(face, corners[0], corners[1], corners[2], corners[3]);
    sketch.surface(name + ": face", face, colourOf(kColours[verdict], kFaceAlpha));
    std::string text = std::to_string(window.id) + (is_target ? ", target: " : ": ") + kVerdicts[verdict];
    if (window.failures > 0) text += ", given up";
    sketch.text(name + ": text", above(*T.value, window.height, kNumberAboveM), text);
  }
  return sketch.markers();
}

}  // namespace window_ingress::adapters
