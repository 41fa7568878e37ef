#include "simulation/rendering/edge_smoother.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace window_ingress::simulation {
namespace {

// OpenGL snaps vertices to a grid of 1/256 px: sides may pass on the other side of a centre.
constexpr double kSnap_px = 0.02;

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

// Follows a side of a face pixel by pixel along its longer axis.
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
  const std::ptrdiff_t right = 1, down = camera_.width, stride = flat ? down : right;
  for (int i = first; i <= last; ++i) {
    const double at = p[across] + slope[across] * (i - p[along]);
    if (!(at >= other.start - kSnap_px && at < other.end - 1 + kSnap_px)) continue;
    const std::ptrdiff_t origin = i * (flat ? right : down);
    const auto differs = [&](int k) {
      if (k < other.start || k >= other.end - 1) return false;
      const std::uint8_t* pixel = drawn_ + 4 * (origin + k * stride);
      return (pixel[3] == surface) != (pixel[4 * stride + 3] == surface);
    };
    int before = static_cast<int>(std::floor(at));
    if (!differs(before)) {
      const double part = at - before;
      before += part < kSnap_px ? -1 : part > 1.0 - kSnap_px ? 1 : 0;
      if (!differs(before)) continue;
    }
    keepNearest({origin + before * stride, stride, p.z() + slope.z() * (i - p[along]), at - (before - 0.5),
                 std::abs(slope[across])});
  }
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
