#include "simulation/rendering/edge_smoother.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace window_ingress::simulation {
namespace {

constexpr double kSnap_px =
    0.02;  // OpenGL snaps vertices to a grid of 1/256 px: sides may pass on the other side of a centre

// Integral of clamp(x, 0, 1).
double ramp(double x) { return x <= 0.0 ? 0.0 : x >= 1.0 ? x - 0.5 : 0.5 * x * x; }

// Part of the unit interval before a line that crosses the interval at `middle` and moves by `slope` from one
// end of the row to the other.
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

// A side of a face, followed pixel by pixel along its longer axis.
struct EdgeSmoother::Walk {
  std::uint8_t surface;
  std::ptrdiff_t along_stride, across_stride;  // [px]
  int across_first, across_last;
  double from, across, slope, inverse_depth, inverse_depth_slope;  // at `from` on the long axis; per pixel
};

EdgeSmoother::EdgeSmoother(const geometry::PinholeCamera& camera) : camera_(camera) {
  for (auto& found : found_) found.assign(static_cast<std::size_t>(camera.width) * camera.height, 0);
}

void EdgeSmoother::smooth(const std::vector<Face>& faces, const std::vector<std::size_t>& visible,
                          const Eigen::Isometry3d& T_camera_window, const cv::Mat& drawn,
                          const cv::Range& rows, cv::Mat& image) {
  CV_Assert(drawn.isContinuous() && image.isContinuous());
  drawn_ = drawn.data;
  image_ = image.data;
  rows_ = rows;
  for (const std::size_t i : visible) {
    const Face& face = faces[i];
    std::array<Eigen::Vector3d, 4> corners;
    for (int k = 0; k < 4; ++k) corners[k] = T_camera_window * face.corners[k];
    for (int k = 0; k < 4; ++k) follow(corners[k], corners[(k + 1) % 4], face.surface);
  }
  mixAll();
}

void EdgeSmoother::follow(const Eigen::Vector3d& from_camera, const Eigen::Vector3d& to_camera,
                          std::uint8_t surface) {
  Eigen::Vector3d a = from_camera, b = to_camera;
  if (std::max(a.z(), b.z()) <= kNear_m) return;
  if (a.z() < kNear_m) a += (kNear_m - a.z()) / (b.z() - a.z()) * (b - a);
  if (b.z() < kNear_m) b += (kNear_m - b.z()) / (a.z() - b.z()) * (a - b);
  const auto project = [this](const Eigen::Vector3d& point) {
    const double inverse = 1.0 / point.z();
    return Eigen::Vector3d(camera_.fx * point.x() * inverse + camera_.cx,
                           camera_.fy * point.y() * inverse + camera_.cy, inverse);
  };
  Eigen::Vector3d p = project(a), q = project(b);
  const bool flat = std::abs(q.x() - p.x()) > std::abs(q.y() - p.y());
  const int along = flat ? 0 : 1, across = 1 - along;
  if (p[along] > q[along]) std::swap(p, q);
  const cv::Range columns(0, camera_.width), allowed = flat ? columns : rows_, other = flat ? rows_ : columns;
  const int first = static_cast<int>(std::ceil(std::clamp<double>(p[along], allowed.start, allowed.end)));
  const int last = static_cast<int>(std::floor(std::clamp<double>(q[along], -1.0, allowed.end - 1)));
  if (last < first) return;
  const Eigen::Vector3d slope = (q - p) / (q[along] - p[along]);
  const int right = 1, down = camera_.width;
  const Walk walk{surface,  flat ? right : down, flat ? down : right, other.start, other.end - 1,
                  p[along], p[across],           slope[across],       p.z(),       slope.z()};
  for (int i = first; i <= last; ++i) step(walk, i);
}

void EdgeSmoother::step(const Walk& walk, int along) {
  const double across = walk.across + walk.slope * (along - walk.from);
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
  keepNearest({along * walk.along_stride + before * walk.across_stride, walk.across_stride,
               walk.inverse_depth + walk.inverse_depth_slope * (along - walk.from), across - (before - 0.5),
               std::abs(walk.slope)});
}

void EdgeSmoother::keepNearest(const Crossing& crossing) {
  int& number = found_[crossing.stride == 1 ? 0 : 1][crossing.first];
  if (number == 0) {
    crossings_.push_back(crossing);
    number = static_cast<int>(crossings_.size());
  } else if (crossing.inverse_depth > crossings_[number - 1].inverse_depth) {
    crossings_[number - 1] = crossing;
  }
}

void EdgeSmoother::mixAll() {
  for (const Crossing& crossing : crossings_) {
    const std::ptrdiff_t first = crossing.first, second = first + crossing.stride;
    mix(image_ + 3 * first, partBefore(crossing.middle, crossing.slope), drawn_ + 4 * second);
    mix(image_ + 3 * second, 1.0 - partBefore(crossing.middle - 1.0, crossing.slope), drawn_ + 4 * first);
    found_[crossing.stride == 1 ? 0 : 1][first] = 0;
  }
  crossings_.clear();
}

}  // namespace window_ingress::simulation
