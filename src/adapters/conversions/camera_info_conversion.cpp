#include <algorithm>
#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

using geometry::PinholeCamera;

constexpr std::uint32_t kLargestSidePx = 20000;
constexpr std::uint32_t kMaxBinning = 16;

template <typename Array>
bool finite(const Array& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

template <typename Array>
bool zero(const Array& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return number == 0.0; });
}

std::string badSize(const sensor_msgs::CameraInfo& m) {
  const bool sane = m.width > 0 && m.height > 0 && m.width <= kLargestSidePx && m.height <= kLargestSidePx;
  return sane ? "" : formatted("size %ux%u is not within 1..20000 pixels", m.width, m.height);
}

std::string badNumbers(const sensor_msgs::CameraInfo& m) {
  if (!finite(m.K) || !finite(m.P) || !finite(m.R) || !finite(m.D))
    return "K, D, R or P holds a number that is not finite";
  if (zero(m.R) && !zero(m.P))
    return "R is zero, which is not a rotation, although P is set; set R to the identity if nothing is "
           "rectified";
  if (zero(m.K)) return "uncalibrated: K is zero; calibrate the camera or load its calibration in the driver";
  return "";
}

std::string badRegion(const sensor_msgs::CameraInfo& m, bool rectified) {
  if (m.binning_x > kMaxBinning || m.binning_y > kMaxBinning)
    return formatted("binning %ux%u is above 16", m.binning_x, m.binning_y);
  const bool full = m.roi.width == 0 && m.roi.height == 0;
  const bool fits = std::uint64_t{m.roi.x_offset} + m.roi.width <= m.width &&
                    std::uint64_t{m.roi.y_offset} + m.roi.height <= m.height;
  if (!full && (!fits || m.roi.width == 0 || m.roi.height == 0))
    return "region of interest lies outside the image";
  const bool whole = full || (m.roi.width == m.width && m.roi.height == m.height);
  if (rectified && !whole && !m.roi.do_rectify)
    return "region of interest of the raw image (do_rectify false) cannot be applied to rectified images";
  return "";
}

std::string badProjection(const sensor_msgs::CameraInfo& m, bool rectified) {
  if (!rectified) return m.K[0] > 0.0 && m.K[4] > 0.0 ? "" : "focal length in K must be positive";
  if (zero(m.P)) return "P is zero, but the images are said to be rectified (image_is_rectified)";
  return m.P[0] > 0.0 && m.P[5] > 0.0 ? "" : "focal length in P must be positive";
}

std::string whyRefused(const sensor_msgs::CameraInfo& m, bool rectified) {
  for (const std::string& fault :
       {badSize(m), badNumbers(m), badRegion(m, rectified), badProjection(m, rectified)})
    if (!fault.empty()) return fault;
  return "";
}

PinholeCamera fullCamera(const sensor_msgs::CameraInfo& m, bool rectified) {
  PinholeCamera camera;
  camera.width = static_cast<int>(m.width);
  camera.height = static_cast<int>(m.height);
  camera.fx = rectified ? m.P[0] : m.K[0];
  camera.fy = rectified ? m.P[5] : m.K[4];
  camera.cx = rectified ? m.P[2] : m.K[2];
  camera.cy = rectified ? m.P[6] : m.K[5];
  return camera;
}

// First the region, in unbinned pixels, then the binning. A binned pixel's centre is the mean of its pixels'
// centres.
void cropAndBin(PinholeCamera& camera, const sensor_msgs::CameraInfo& m) {
  const int bin_x = std::max(1, static_cast<int>(m.binning_x)),
            bin_y = std::max(1, static_cast<int>(m.binning_y));
  if (m.roi.width > 0) camera.width = static_cast<int>(m.roi.width);
  if (m.roi.height > 0) camera.height = static_cast<int>(m.roi.height);
  camera.cx = (camera.cx - m.roi.x_offset + 0.5) / bin_x - 0.5;
  camera.cy = (camera.cy - m.roi.y_offset + 0.5) / bin_y - 0.5;
  camera.fx /= bin_x;
  camera.fy /= bin_y;
  camera.width /= bin_x;
  camera.height /= bin_y;
}

}  // namespace

Converted<PinholeCamera> cameraFromMsg(const sensor_msgs::CameraInfo& message, bool rectified) {
  std::string reason = whyRefused(message, rectified);
  if (!reason.empty()) return {std::nullopt, reason};
  PinholeCamera camera = fullCamera(message, rectified);
  if (!rectified) reason = geometry::setLens(message.distortion_model, message.D, camera);
  if (!reason.empty()) return {std::nullopt, reason};
  cropAndBin(camera, message);
  const std::vector<std::string> faults = camera.validate();
  if (!faults.empty()) return {std::nullopt, faults.front()};
  return {camera, ""};
}

std::string misfitOf(const PinholeCamera& camera, const std::string& camera_frame_id,
                     const std::string& topic, int width_px, int height_px, const std::string& frame_id) {
  const std::string info = "camera_info on " + topic;
  if (camera.width != width_px || camera.height != height_px)
    return formatted("sizes differ: the image has %dx%d pixels, %s is for %dx%d", width_px, height_px,
                     info.c_str(), camera.width, camera.height);
  if (!frame_id.empty() && frame_id != camera_frame_id)
    return "frames differ: the image has frame_id '" + frame_id + "', " + info + " '" + camera_frame_id + "'";
  return "";
}

sensor_msgs::CameraInfo toMsg(const PinholeCamera& camera) {
  sensor_msgs::CameraInfo message;
  message.width = static_cast<std::uint32_t>(camera.width);
  message.height = static_cast<std::uint32_t>(camera.height);
  const bool fisheye = camera.model == geometry::LensModel::kEquidistant;
  message.distortion_model = fisheye ? "equidistant" : "plumb_bob";
  message.D.assign(camera.distortion.begin(), camera.distortion.end() - fisheye);
  message.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  message.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  message.P = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return message;
}

}  // namespace window_ingress::adapters
