#include "detection/reference/side_profile.hpp"

#include <algorithm>
#include <cmath>

#include "detection/alignment/rectangle_prior.hpp"
#include "window_ingress/geometry/unit_square.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

constexpr int kFewestAcross = 12;
constexpr double kFrameFrom = 0.015, kFrameTo = 0.06;   ///< band of the frame, from a border [mean sides]
constexpr double kWallFrom = 0.16, kWallTo = 0.2;       ///< band of the wall, from a border [mean sides]
constexpr double kBeyondFrom = 0.08, kBeyondTo = 0.15;  ///< beyond a side's end [sides]
constexpr double kAlikePart = 0.2;  ///< of the contrast of frame and wall: colours of one frame differ less
constexpr int kFewestAlike = 3;     ///< sides of a frame that must agree in colour

// Point beside side `i` of the unit square: t along the side, `out` outwards [sides].
Vector2d beside(int i, double t, double out) {
  switch (i) {
    case geometry::kTop:
      return {t, -out};
    case geometry::kRight:
      return {1.0 + out, t};
    case geometry::kBottom:
      return {1.0 - t, 1.0 + out};
    default:
      return {-out, 1.0 - t};
  }
}

// Mean colour along side `i`; false if less than a third of the side lies within the image.
bool meanAlong(const cv::Mat& image, const geometry::UnitSquare& map, const geometry::PinholeCamera* lens,
               int i, double out, const ProfileReach& reach, Vector3f& mean) {
  const double right = image.cols - 0.5, bottom = image.rows - 0.5;
  int count = 0;
  mean.setZero();
  for (int n = 0; n < reach.along; ++n) {
    Vector2d p = map.toImage(beside(i, reach.from + (reach.to - reach.from) * (n + 0.5) / reach.along, out));
    if (lens) p = lens->distort(p);
    if (!(p.x() > -0.5 && p.y() > -0.5 && p.x() < right && p.y() < bottom)) continue;
    const cv::Vec3b& pixel =
        image.ptr<cv::Vec3b>(static_cast<int>(p.y() + 0.5))[static_cast<int>(p.x() + 0.5)];
    mean += Vector3f(pixel[0], pixel[1], pixel[2]);
    ++count;
  }
  mean /= static_cast<float>(std::max(count, 1));
  return count >= reach.along / 3;
}

}  // namespace

bool SideProfile::mean(double from, double to, Vector3f& colour) const {
  if (means.empty()) return false;
  const int count = static_cast<int>(means.size());
  const int begin = static_cast<int>(std::ceil((from - first) / step - 1e-9));
  const int last = std::max(begin, static_cast<int>(std::floor((to - first) / step)));
  if (begin < 0 || last >= count) return false;
  colour.setZero();
  for (int k = begin; k <= last; ++k) colour += means[k];
  colour /= static_cast<float>(last - begin + 1);
  return true;
}

float SideProfile::change(int i) const {
  return i < 1 || i + 1 >= static_cast<int>(means.size()) ? 0.0F : (means[i + 1] - means[i - 1]).norm();
}

double SideProfile::largestChange(double from, double to, double* place) const {
  if (means.empty()) return 0.0;
  const int begin = std::max(1, static_cast<int>(std::floor((from - first) / step)));
  const int last =
      std::min(static_cast<int>(means.size()) - 2, static_cast<int>(std::ceil((to - first) / step)));
  double most = 0.0;
  for (int k = begin; k <= last; ++k)
    if (change(k) > most) {
      most = change(k);
      if (place) *place = at(k);
    }
  return most;
}

void measureSides(const cv::Mat& image, const geometry::Quadrilateral& loop,
                  const geometry::PinholeCamera* camera, const ProfileReach& reach,
                  std::array<SideProfile, 4>& sides) {
  const geometry::PinholeCamera* lens = geometry::lensOf(camera);
  const geometry::Quadrilateral ideal = geometry::undistorted(loop, lens);
  const geometry::UnitSquare map(ideal);
  const Vector2d shape = shapeOf(reach.aspect);
  const double length = reach.inward + reach.outward;
  const int steps =
      std::clamp(static_cast<int>(length * geometry::meanSide(ideal)), kFewestAcross, reach.across);
  for (int i = 0; i < 4; ++i) {
    SideProfile& profile = sides[i];
    profile.first = -reach.inward;
    profile.step = length / steps;
    profile.means.clear();
    const double across = i % 2 ? shape.x() : shape.y();
    Vector3f mean;
    for (int k = 0; k < steps && meanAlong(image, map, lens, i, profile.at(k) / across, reach, mean); ++k)
      profile.means.push_back(mean);
  }
}

FrameEnds framesBeyond(const cv::Mat& image, const geometry::Quadrilateral& loop,
                       const geometry::PinholeCamera* camera, std::array<SideProfile, 4>& sides) {
  std::array<Vector3f, 4> frames, walls;
  std::array<bool, 4> seen{};
  ProfileReach reach{0.0, kWallTo + kFrameFrom};
  measureSides(image, loop, camera, reach, sides);
  for (int i = 0; i < 4; ++i)
    seen[i] = sides[i].mean(kFrameFrom, kFrameTo, frames[i]) && sides[i].mean(kWallFrom, kWallTo, walls[i]);
  const auto is_frame = [&](const Vector3f& colour, int side) {
    return (colour - frames[side]).norm() < kAlikePart * (walls[side] - frames[side]).norm();
  };
  const auto tells = [&](int side) {
    if (!seen[side]) return false;
    int alike = 0;
    for (int k = 0; k < 4; ++k) alike += seen[k] && is_frame(frames[k], side);
    return alike >= kFewestAlike;
  };
  FrameEnds beyond{};
  for (int end = 0; end < 2; ++end) {
    reach.from = end ? 1.0 + kBeyondFrom : -kBeyondTo;
    reach.to = end ? 1.0 + kBeyondTo : -kBeyondFrom;
    measureSides(image, loop, camera, reach, sides);
    Vector3f colour;
    for (int i = 0; i < 4; ++i)
      beyond[i][end] = tells(i) && sides[i].mean(kFrameFrom, kFrameTo, colour) && is_frame(colour, i);
  }
  return beyond;
}

}  // namespace window_ingress::detection
