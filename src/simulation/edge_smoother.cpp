#include "edge_smoother.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace window_ingress::simulation {
namespace {

constexpr double kNear_m = 0.03;
constexpr double kSnap_px =
    0.02;  // OpenGL moves vertices to a grid of 1/256 px: sides may pass beyond a centre

// Integral of clamp(x, 0, 1).
double ramp(double x) { return x <= 0.0 ? 0.0 : x >= 1.0 ? x - 0.5 : 0.5 * x * x; }

// Part of the unit interval before a line that crosses it at `middle` and moves by `slope` from one end of
// the row to the other.
double partBefore(double middle, double slope) {
  if (slope < 1e-6) return std::clamp(middle, 0.0, 1.0);
  return (ramp(middle + 0.5 * slope) - ramp(middle - 0.5 * slope)) / slope;
}

void mix(std::uint8_t* pixel, double own_part, const std::uint8_t* other) {
  const int own = static_cast<int>(std::lround(256.0 * own_part));
  for (int c = 0; c < 3; ++c)
    pixel[c] = static_cast<std::uint8_t>((own * pixel[c] + (256 - own) * other[2 - c] + 128) >> 8);
}

}  // namespace

// A side, followed pixel by pixel along the axis along which it is longer.
struct EdgeSmoother::Walk {
  std::uint8_t surface, bit;
  int across_count;
  std::ptrdiff_t along_stride, across_stride;  // [px]
  int across_first, across_last;
  double slope;  // of the position across, without sign
};

EdgeSmoother::EdgeSmoother(const geometry::PinholeCamera& camera)
    : camera_(camera), mixed_(static_cast<std::size_t>(camera.width) * camera.height) {}

void EdgeSmoother::smooth(const std::vector<Face>& faces, const std::vector<std::size_t>& near_first,
                          const Eigen::Isometry3d& T_camera_window, const cv::Mat& drawn,
                          const cv::Range& rows, cv::Mat& image) {
  CV_Assert(drawn.isContinuous() && image.isContinuous());
  drawn_ = drawn.data;
  image_ = image.data;
  rows_ = rows;
  std::fill(mixed_.begin() + static_cast<std::ptrdiff_t>(rows.start) * camera_.width,
            mixed_.begin() + static_cast<std::ptrdiff_t>(rows.end) * camera_.width, 0);
  for (const std::size_t i : near_first) {
    const Face& face = faces[i];
    std::array<Eigen::Vector3d, 4> corners;
    for (int k = 0; k < 4; ++k) corners[k] = T_camera_window * face.corners[k];
    for (int k = 0; k < 4; ++k) follow(corners[k], corners[(k + 1) % 4], face.surface);
  }
}

void EdgeSmoother::follow(const Eigen::Vector3d& from_camera, const Eigen::Vector3d& to_camera,
                          std::uint8_t surface) {
  Eigen::Vector3d a = from_camera, b = to_camera;
  if (std::max(a.z(), b.z()) <= kNear_m) return;
  if (a.z() < kNear_m) a += (kNear_m - a.z()) / (b.z() - a.z()) * (b - a);
  if (b.z() < kNear_m) b += (kNear_m - b.z()) / (a.z() - b.z()) * (a - b);
  const Eigen::Vector2d f(camera_.fx, camera_.fy), c(camera_.cx, camera_.cy);
  Eigen::Vector2d p = f.cwiseProduct(a.head<2>() / a.z()) + c, q = f.cwiseProduct(b.head<2>() / b.z()) + c;
  const int along = std::abs(q.x() - p.x()) > std::abs(q.y() - p.y()) ? 0 : 1, across = 1 - along;
  if (p[along] > q[along]) std::swap(p, q);
  const int first_allowed = along == 0 ? 0 : rows_.start,
            end_allowed = along == 0 ? camera_.width : rows_.end;
  const int first = static_cast<int>(std::ceil(std::clamp<double>(p[along], first_allowed, end_allowed)));
  const int last = static_cast<int>(std::floor(std::clamp<double>(q[along], -1.0, end_allowed - 1)));
  if (last < first) return;
  const double slope = (q[across] - p[across]) / (q[along] - p[along]);
  Walk walk;
  walk.surface = surface;
  walk.bit = along == 0 ? 2 : 1;
  walk.along_stride = along == 0 ? 1 : camera_.width;
  walk.across_stride = along == 0 ? camera_.width : 1;
  walk.across_first = along == 0 ? rows_.start : 0;
  walk.across_last = (along == 0 ? rows_.end : camera_.width) - 1;
  walk.slope = std::abs(slope);
  for (int i = first; i <= last; ++i) step(walk, i, p[across] + slope * (i - p[along]));
}

void EdgeSmoother::step(const Walk& walk, int along, double across) {
  if (!(across >= walk.across_first - kSnap_px && across < walk.across_last + kSnap_px)) return;
  int before = static_cast<int>(std::floor(across));
  const auto differs = [&](int at) {
    if (at < walk.across_first || at >= walk.across_last) return false;
    const std::uint8_t* pixel = drawn_ + 4 * (along * walk.along_stride + at * walk.across_stride);
    return (pixel[3] == walk.surface) != (pixel[4 * walk.across_stride + 3] == walk.surface);
  };
  if (!differs(before)) {
    const double part = across - before;
    before += part < kSnap_px ? -1 : part > 1.0 - kSnap_px ? 1 : 0;
    if (!differs(before)) return;
  }
  const std::ptrdiff_t here = along * walk.along_stride + before * walk.across_stride,
                       there = here + walk.across_stride;
  if (mixed_[here] & walk.bit) return;
  mixed_[here] |= walk.bit;
  const double middle = across - (before - 0.5);
  mix(image_ + 3 * here, partBefore(middle, walk.slope), drawn_ + 4 * there);
  mix(image_ + 3 * there, 1.0 - partBefore(middle - 1.0, walk.slope), drawn_ + 4 * here);
}

}  // namespace window_ingress::simulation
