#include "detection/reference/frame_ends.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kFrameFrom = 0.015, kFrameTo = 0.06;  ///< band of the frame, from a border [mean sides]
constexpr double kWallFrom = 0.16, kWallTo = 0.2;      ///< band of the wall, from a border [mean sides]
constexpr double kAlikePart = 0.2;  ///< of the contrast of frame and wall: colours of one frame differ less
constexpr int kFewestAlike = 3;     ///< sides of a frame that must agree in colour
constexpr double kBeyondFrom = 0.08,
                 kBeyondTo = 0.15;  ///< beyond a side's end, where its frame may continue [sides]

}  // namespace

FrameEnds framesBeyond(const cv::Mat& image, const geometry::Quadrilateral& ideal,
                       const geometry::PinholeCamera* lens, std::array<SideProfile, 4>& sides) {
  std::array<Eigen::Vector3f, 4> frames, walls;
  std::array<bool, 4> seen{};
  ProfileReach reach{0.0, kWallTo + kFrameFrom};
  measureSides(image, ideal, lens, reach, sides);
  for (int i = 0; i < 4; ++i)
    seen[i] = sides[i].mean(kFrameFrom, kFrameTo, frames[i]) && sides[i].mean(kWallFrom, kWallTo, walls[i]);
  const auto is_frame = [&](const Eigen::Vector3f& colour, int side) {
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
    measureSides(image, ideal, lens, reach, sides);
    Eigen::Vector3f colour;
    for (int i = 0; i < 4; ++i)
      beyond[i][end] = tells(i) && sides[i].mean(kFrameFrom, kFrameTo, colour) && is_frame(colour, i);
  }
  return beyond;
}

}  // namespace window_ingress::detection
