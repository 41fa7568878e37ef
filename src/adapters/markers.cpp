#include "adapters/markers.hpp"

namespace window_ingress::adapters {
namespace {

using visualization_msgs::Marker;

constexpr double kLineWidthM = 0.03;
constexpr double kArrowLengthM = 0.8;
constexpr double kTextHeightM = 0.15, kTextAboveM = 0.4;
constexpr double kLifetimeSec = 1.0;

geometry_msgs::Point toPoint(const Eigen::Vector3d& p) {
  geometry_msgs::Point point;
  point.x = p.x();
  point.y = p.y();
  point.z = p.z();
  return point;
}

std_msgs::ColorRGBA colour(float r, float g, float b) {
  std_msgs::ColorRGBA rgba;
  rgba.r = r;
  rgba.g = g;
  rgba.b = b;
  rgba.a = 1.0F;
  return rgba;
}

Marker makeMarker(const std::string& name, int type, const ros::Time& stamp, const std::string& frame_id) {
  Marker marker;
  marker.header.stamp = stamp;
  marker.header.frame_id = frame_id;
  marker.ns = name;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.lifetime = ros::Duration(kLifetimeSec);
  return marker;
}

Marker makeArrow(Marker marker, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  marker.points = {toPoint(from), toPoint(to)};
  marker.scale.x = kLineWidthM;
  marker.scale.y = 2.0 * kLineWidthM;
  marker.scale.z = 4.0 * kLineWidthM;
  return marker;
}

}  // namespace

geometry_msgs::PolygonStamped openingPolygon(const Eigen::Isometry3d& T_frame_window,
                                             const geometry::OpeningSize& opening, const ros::Time& stamp,
                                             const std::string& frame_id) {
  geometry_msgs::PolygonStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = frame_id;
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

visualization_msgs::MarkerArray windowMarkers(const pose::FilteredWindow& window, const std::string& text,
                                              const ros::Time& stamp, const std::string& frame_id) {
  visualization_msgs::MarkerArray markers;
  const auto add = [&](const std::string& name, const Eigen::Isometry3d& T,
                       const std_msgs::ColorRGBA& shade) {
    Marker border = makeMarker(name + "_border", Marker::LINE_STRIP, stamp, frame_id);
    for (const Eigen::Vector3d& corner : geometry::openingCorners(window.size.size))
      border.points.push_back(toPoint(T * corner));
    border.points.push_back(border.points.front());
    border.scale.x = kLineWidthM;
    Marker normal = makeArrow(makeMarker(name + "_normal", Marker::ARROW, stamp, frame_id), T.translation(),
                              T * Eigen::Vector3d(kArrowLengthM, 0.0, 0.0));
    border.color = normal.color = shade;
    markers.markers.push_back(border);
    markers.markers.push_back(normal);
  };
  add("window", window.T_odom_window,
      window.sign_trusted ? colour(0.1F, 0.8F, 0.2F) : colour(1.0F, 0.6F, 0.0F));
  if (window.alternative) add("alternative", window.alternative->T_odom_window, colour(0.5F, 0.5F, 0.5F));
  Marker label = makeMarker("window_text", Marker::TEXT_VIEW_FACING, stamp, frame_id);
  const double above_m = 0.5 * window.size.size.height_m + kTextAboveM;
  label.pose.position = toPoint(window.T_odom_window.translation() + Eigen::Vector3d(0.0, 0.0, above_m));
  label.text = text;
  label.scale.z = kTextHeightM;
  label.color = colour(1.0F, 1.0F, 1.0F);
  markers.markers.push_back(label);
  return markers;
}

visualization_msgs::MarkerArray flightMarkers(const navigation::NavigatorOutput& output,
                                              const navigation::VehicleState& vehicle, const ros::Time& stamp,
                                              const std::string& odom_frame) {
  const Eigen::Vector3d position = vehicle.T_odom_base.translation();
  Marker wish = makeArrow(makeMarker("setpoint", Marker::ARROW, stamp, odom_frame), position,
                          position + output.setpoint.velocity_odom_mps);
  wish.color = colour(0.2F, 0.4F, 1.0F);
  Marker text = makeMarker("state", Marker::TEXT_VIEW_FACING, stamp, odom_frame);
  text.pose.position = toPoint(position + Eigen::Vector3d(0.0, 0.0, kTextAboveM));
  text.text = std::string(navigation::toString(output.state)) + "\n" + output.reason;
  text.scale.z = kTextHeightM;
  text.color = colour(1.0F, 1.0F, 1.0F);
  visualization_msgs::MarkerArray markers;
  markers.markers = {wish, text};
  return markers;
}

}  // namespace window_ingress::adapters
