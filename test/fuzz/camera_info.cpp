#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"
#include "bytes.hpp"
#include "targets.hpp"

namespace window_ingress::fuzz {
namespace {

template <typename Numbers>
void fill(Bytes& bytes, Numbers& numbers, double largest) {
  for (double& number : numbers) number = bytes.number(-largest, largest);
}

sensor_msgs::CameraInfo anyInfo(Bytes& bytes) {
  static const char* const kModels[] = {"plumb_bob", "rational_polynomial", "equidistant", "", "fisheye"};
  sensor_msgs::CameraInfo info;
  const std::uint8_t shape = bytes.take<std::uint8_t>();
  info.width = shape & 1 ? bytes.take<std::uint32_t>() : bytes.take<std::uint16_t>();
  info.height = shape & 2 ? bytes.take<std::uint32_t>() : bytes.take<std::uint16_t>();
  info.distortion_model = shape & 4 ? bytes.text(32) : kModels[bytes.below(5)];
  info.D.resize(shape & 8 ? bytes.below(2000) : bytes.below(10));
  fill(bytes, info.D, 1.0);
  fill(bytes, info.K, 2000.0);
  fill(bytes, info.R, 1.0);
  fill(bytes, info.P, 2000.0);
  if (!(shape & 16)) return info;
  info.binning_x = bytes.take<std::uint32_t>() >> bytes.take<std::uint8_t>() % 32;
  info.binning_y = bytes.take<std::uint8_t>();
  info.roi.x_offset = bytes.take<std::uint32_t>() >> bytes.take<std::uint8_t>() % 32;
  info.roi.y_offset = bytes.take<std::uint16_t>();
  info.roi.width = bytes.take<std::uint32_t>() >> bytes.take<std::uint8_t>() % 32;
  info.roi.height = bytes.take<std::uint16_t>();
  info.roi.do_rectify = (shape & 32) != 0;
  return info;
}

void check(const geometry::PinholeCamera& camera, Bytes& bytes) {
  require(camera.validate().empty(), "an accepted camera can be used");
  const Eigen::Vector2d pixel(bytes.below(camera.width), bytes.below(camera.height));
  const Eigen::Vector3d ray = camera.ray(pixel);
  require(!ray.allFinite() || std::abs(ray.norm() - 1.0) < 1e-6, "a ray has length one");
  const Eigen::Vector3d point(bytes.number(-5.0, 5.0), bytes.number(-5.0, 5.0), bytes.number(-1.0, 9.0));
  const auto seen = camera.project(point);
  require(!seen || point.z() > 0.0, "what lies behind is not seen");
}

}  // namespace

void camera_info(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const sensor_msgs::CameraInfo info = anyInfo(bytes);
  for (const bool rectified : {false, true}) {
    const auto camera = adapters::cameraFromMsg(info, rectified);
    require(camera.value.has_value() == camera.reason.empty(), "a camera or a reason");
    if (camera) check(*camera.value, bytes);
  }
}

}  // namespace window_ingress::fuzz
