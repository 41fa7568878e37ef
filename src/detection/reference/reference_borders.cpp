#include "detection/reference/reference_borders.hpp"

#include <algorithm>
#include <cmath>

#include "detection/alignment/rectangle_prior.hpp"
#include "detection/reference/haze.hpp"
#include "window_ingress/geometry/unit_square.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;
using geometry::Quadrilateral;
using Bands = ReferenceBorders::Bands;

constexpr int kBands = ReferenceBorders::kBands;
constexpr double kBandWidth = 0.02;                            ///< [mean sides of the opening]
constexpr double kBorderInward = 0.14, kBorderOutward = 0.40;  ///< reach from a rough loop [its mean sides]
constexpr double kUnlikeScale = 0.10;   ///< colour difference that reduces a border's score by a factor of e
constexpr double kMinEndChange = 10.0;  ///< of the mean colour at the reference's frame's end [grey levels]
constexpr double kStepFull = 0.06;      ///< colour difference across a border that counts fully
constexpr double kBrightnessWeight = 0.25;  ///< of relative brightness against chroma
constexpr double kClear = 0.006;            ///< nearer to a border colours are mixed [mean sides]
constexpr double kFaintestFrame = 0.10;     ///< least difference of frame and wall; bricks and joints: 0.08
constexpr double kEndReach = 0.03;          ///< search range about the expected end of a frame [mean sides]
constexpr double kPeakPart = 0.7;     ///< of the largest change nearby, which the place itself must show
constexpr double kWithoutEnd = 0.35;  ///< score of a border whose frame does not end there
constexpr float kHazeFrom = 40.0F;    ///< haze is possible if the darkest place is brighter [grey levels]
constexpr double kNoHaze = 1e3;
constexpr double kFarAway = 1.5;    ///< standard deviation of a border from the rough loop [kBorderInward]
constexpr double kSureEnd = 0.95;   ///< match of a frame's end that predicts the border without an edge
constexpr double kPredicted = 0.8;  ///< score of a border predicted by its frame's end
constexpr double kThinnestFrame = 0.015;  ///< [mean sides]
constexpr double kMinChange = 3.0;        ///< least change of the mean colour at a border [grey levels]

Vector3f features(const Vector3f& bgr) {
  const float sum = bgr.sum() + 12.0F;
  return {(bgr[2] + 4.0F) / sum, (bgr[1] + 4.0F) / sum, std::log(sum)};
}

double difference(const Vector3f& a, const Vector3f& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]) + kBrightnessWeight * std::min(1.0F, std::abs(a[2] - b[2]));
}

// Colours of the bands outwards from a border; false if the profile ends before the second.
bool coloursFrom(const SideProfile& profile, double border, Bands& colours) {
  int filled = 0;
  for (; filled < kBands; ++filled) {
    const double from = border + filled * kBandWidth;
    if (!profile.mean(from + (filled == 0 ? kClear : 0.0), from + kBandWidth, colours[filled])) break;
  }
  if (filled < 2) return false;
  for (int b = filled; b < kBands; ++b) colours[b] = colours[filled - 1];
  return true;
}

// Features of the bands; brightness relative to the outermost band.
Bands featuresOf(const Bands& colours) {
  Bands bands;
  for (int b = 0; b < kBands; ++b) bands[b] = features(colours[b]);
  const float outermost = bands[kBands - 1][2];
  for (Vector3f& band : bands) band[2] -= outermost;
  return bands;
}

double unlike(const Bands& bands, const Bands& reference) {
  double sum = 0.0;
  for (int b = 0; b < kBands; ++b) sum += difference(bands[b], reference[b]);
  return sum / kBands;
}

}  // namespace

// As `unlike`, after removal of the haze that fits best; kNoHaze if none is possible.
double ReferenceBorders::unlikeThroughHaze(const Bands& colours, int side) const {
  const Bands& wanted = reference_colours_[side];
  const Vector3f &wall = colours[kBands - 1], &wanted_wall = wanted[kBands - 1];
  float along = 0.0F, square = 1.0F;
  for (int b = 0; b < kBands; ++b) {
    along += (colours[b] - wall).dot(wanted[b] - wanted_wall);
    square += (wanted[b] - wanted_wall).squaredNorm();
  }
  const auto haze = hazeThatLeaves(along / square, wanted_wall, wall, darkest_);
  if (!haze) return kNoHaze;
  Bands clear;
  for (int b = 0; b < kBands; ++b) clear[b] = haze->off(colours[b]).cwiseMax(0.0F);
  return unlike(featuresOf(clear), reference_[side]);
}

void ReferenceBorders::learn(const cv::Mat& image, const Quadrilateral& opening) {
  known_ = false;
  if (image.type() != CV_8UC3 || image.empty() || !geometry::isConvex(opening)) return;
  aspect_ = geometry::aspectRatio(opening);
  measureSides(image, opening, nullptr, {kBorderInward, kBorderOutward, aspect_, kFine.along, kFine.across},
               sides_);
  double frame = 0.0;
  for (int i = 0; i < 4; ++i) {
    if (!coloursFrom(sides_[i], 0.0, reference_colours_[i])) return;
    reference_[i] = featuresOf(reference_colours_[i]);
    double end = 0.0;
    const double contrast = sides_[i].largestChange(kThinnestFrame, kBands * kBandWidth, &end);
    frame_widths_[i] = contrast > kMinEndChange ? end : 0.0;
    frame += 0.25 * difference(reference_[i][1], reference_[i][kBands - 1]);
  }
  frameless_ = frame < kFaintestFrame;
  known_ = true;
}

// How well the frame's width matches the reference's; 1 also where the reference shows no end of the frame.
double ReferenceBorders::frameEnds(int side, double border) const {
  if (frame_widths_[side] <= 0.0) return 1.0;
  const SideProfile& profile = sides_[side];
  const double end = border + frame_widths_[side];
  const double there = profile.largestChange(end - 0.5 * profile.step, end + 0.5 * profile.step);
  const double near = profile.largestChange(end - kEndReach, end + kEndReach);
  return kWithoutEnd +
         (1.0 - kWithoutEnd) * (near > kMinChange ? std::min(1.0, there / (kPeakPart * near)) : 0.0);
}

// The edge whose outward colours best match the reference while the colour inside differs; returns its score.
double ReferenceBorders::choose(int side, double& border) const {
  const SideProfile& profile = sides_[side];
  const int count = static_cast<int>(profile.means.size());
  const bool framed = frame_widths_[side] > 0.0;
  double best = 0.0;
  Bands bands;
  for (int k = 1; k + 1 < count; ++k) {
    const double here = profile.change(k), at = profile.at(k);
    const bool peak = here >= kMinChange && here >= profile.change(k - 1) && here >= profile.change(k + 1);
    const double ends = frameEnds(side, at);
    if (!peak && !(framed && ends > kSureEnd)) continue;
    Vector3f within;
    if (!coloursFrom(profile, at, bands) || !profile.mean(at - kBandWidth, at - kClear, within)) continue;
    const Bands outward = featuresOf(bands);
    double off = unlike(outward, reference_[side]);
    if (framed && darkest_ > kHazeFrom) off = std::min(off, unlikeThroughHaze(bands, side));
    within = features(within);
    within[2] -= features(bands[kBands - 1])[2];
    const double goes_on = difference(within, outward[0]);
    // Where the frame's end gives the position, a faint border suffices.
    const double visible = framed ? ends * (peak ? 1.0 : kPredicted) : std::min(1.0, goes_on / kStepFull);
    const double away = at / kBorderInward / kFarAway;
    const double border_score = std::exp(-off / kUnlikeScale - 0.5 * away * away) * visible;
    if (border_score > best) best = border_score, border = at;
  }
  return best;
}

std::optional<ReferenceBorders::Located> ReferenceBorders::locate(const cv::Mat& image,
                                                                  const Quadrilateral& rough,
                                                                  const geometry::PinholeCamera* camera,
                                                                  const Effort& effort) {
  if (!known_ || image.type() != CV_8UC3 || !geometry::isConvex(rough)) return std::nullopt;
  measureSides(image, rough, camera, {kBorderInward, kBorderOutward, aspect_, effort.along, effort.across},
               sides_);
  darkest_ = 255.0F;
  for (const SideProfile& side : sides_)
    for (const Vector3f& colour : side.means) darkest_ = std::min(darkest_, colour.minCoeff());
  std::array<double, 4> borders{};
  Located located;
  double least = 1.0, mean_score = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double border_score = choose(i, borders[i]);
    if (border_score <= 0.0) return std::nullopt;
    least = std::min(least, border_score), mean_score += 0.25 * border_score;
  }
  located.border_score = std::sqrt(least * mean_score);
  for (int i = 0; i < 4; ++i) borders[i] /= shapeOf(aspect_)[i % 2 ? 0 : 1];
  const double top = -borders[0], right = 1.0 + borders[1], bottom = 1.0 + borders[2], left = -borders[3];
  const geometry::PinholeCamera* lens = geometry::lensOf(camera);
  const geometry::UnitSquare map(geometry::undistorted(rough, lens));
  located.quad = geometry::distorted({map.toImage({left, top}), map.toImage({right, top}),
                                      map.toImage({right, bottom}), map.toImage({left, bottom})},
                                     lens);
  if (!geometry::isFinite(located.quad) || !geometry::isConvex(located.quad)) return std::nullopt;
  return located;
}

}  // namespace window_ingress::detection
