#include "window_ingress/detection/reference_appearance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "detection/reference/ring_colours.hpp"
#include "window_ingress/geometry/unit_square.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;
using geometry::Quadrilateral;

constexpr int kMinBandPixels = 40;      ///< a band with fewer pixels is not compared
constexpr double kGuessedFrame = 0.05;  ///< width of the frame of a target that fills the image [mean sides]
constexpr double kShortestSidePx = 24.0;  ///< of an opening whose frame can be seen
constexpr double kElsewherePart = 0.1;    ///< quantile of the distances at other places: `elsewhere_`
constexpr double kLimitPart = 0.6;  ///< of `elsewhere_`: the limit, somewhat nearer to it than to the target
constexpr double kElsewhereScale = 0.4;  ///< size of the other places [openings]
constexpr int kElsewhereSteps = 7;       ///< positions in each direction
constexpr double kOwnRing = 0.25;      ///< places this close to the border lie on the frame and are left out
constexpr double kEvenDistance = 0.8;  ///< distance at which target and others are equally likely [limits]
constexpr double kHalvingDistance = 0.2;  ///< distance that halves the odds [limits]

// The assumed opening of an image that shows only the target and its frame.
Quadrilateral withinFrame(const cv::Size& size) {
  const double w = size.width - 1.0, h = size.height - 1.0, d = kGuessedFrame * 0.5 * (w + h);
  return {Vector2d(d, d), Vector2d(w - d, d), Vector2d(w - d, h - d), Vector2d(d, h - d)};
}

// True if the border of the unit square passes through a ring of this half width about the point.
bool touchesFrame(const Vector2d& centre) {
  const double off = (centre - Vector2d(0.5, 0.5)).cwiseAbs().maxCoeff() - 0.5;
  return std::abs(off) < 0.5 * kElsewhereScale + kOwnRing * kElsewhereScale;
}

// Distance that most rings at other places of the image exceed, whatever they show.
double distanceElsewhere(const cv::Mat& image, const Quadrilateral& opening, const RingColours& colours) {
  std::vector<double> distances;
  const geometry::UnitSquare square(opening);
  for (int i = 0; i < kElsewhereSteps; ++i)
    for (int k = 0; k < kElsewhereSteps; ++k) {
      const Vector2d at((i + 0.5) / kElsewhereSteps * image.cols, (k + 0.5) / kElsewhereSteps * image.rows);
      if (touchesFrame(square.fromImage(at))) continue;
      Quadrilateral place = opening;
      for (Vector2d& corner : place) corner = at + kElsewhereScale * (corner - geometry::centroid(opening));
      if (const auto other = ringColours(image, place, kMinBandPixels))
        distances.push_back(bhattacharyya(colours.seen, other->seen));
    }
  if (distances.empty()) return 1.0;
  const auto low = distances.begin() + static_cast<std::ptrdiff_t>(kElsewherePart * distances.size());
  std::nth_element(distances.begin(), low, distances.end());
  return *low;
}

}  // namespace

ReferenceAppearance::ReferenceAppearance(const cv::Mat& image, const Quadrilateral& opening)
    : image_(image.clone()), opening_(opening) {
  const auto colours = ringColours(image_, opening_, kMinBandPixels);
  if (!colours || isGrey(image_)) return;
  colours_ = std::make_shared<RingColours>(*colours);
  elsewhere_ = distanceElsewhere(image_, opening_, *colours);
}

ReferenceAppearance::ReferenceAppearance(const cv::Mat& image)
    : ReferenceAppearance(guessed(image, withinFrame(image.size()))) {}

ReferenceAppearance ReferenceAppearance::guessed(const cv::Mat& image, const Quadrilateral& opening) {
  ReferenceAppearance reference(image, opening);
  reference.opening_is_known_ = false;
  return reference;
}

std::string ReferenceAppearance::faultOf(const cv::Mat& image, const Quadrilateral& opening) {
  if (image.empty()) return "the image is empty";
  if (image.type() != CV_8UC1 && image.type() != CV_8UC3)
    return "the image has neither one nor three channels of eight bits";
  if (!geometry::isFinite(opening) || !geometry::isConvex(opening))
    return "the corners are not a convex quadrilateral";
  for (const Vector2d& corner : opening)
    if (corner.x() < -0.5 || corner.y() < -0.5 || corner.x() > image.cols - 0.5 ||
        corner.y() > image.rows - 0.5)
      return "corner (" + std::to_string(std::lround(corner.x())) + ", " +
             std::to_string(std::lround(corner.y())) + ") lies outside the image of " +
             std::to_string(image.cols) + " x " + std::to_string(image.rows) + " pixels";
  const auto sides = geometry::sideLengths(opening);
  const double shortest = *std::min_element(sides.begin(), sides.end());
  if (shortest < kShortestSidePx)
    return "a side of the opening is " + std::to_string(std::lround(shortest)) + " pixels long, " +
           std::to_string(static_cast<int>(kShortestSidePx)) + " are needed";
  return {};
}

std::optional<AppearanceMatch> ReferenceAppearance::compare(const cv::Mat& image,
                                                            const Quadrilateral& opening,
                                                            const AppearanceParams& params) const {
  if (!colours_) return std::nullopt;
  const auto candidate = ringColours(image, opening, kMinBandPixels);
  if (!candidate) return std::nullopt;
  AppearanceMatch match;
  match.distance = bhattacharyya(*colours_, *candidate);
  if (adapted_) match.distance = std::min(match.distance, bhattacharyya(*adapted_, *candidate));
  match.limit = std::min(std::max(kLimitPart * elsewhere_, params.min_distance), params.max_distance);
  const double limit = std::max(match.limit, 1e-3);
  const double power = std::min(1.0, elsewhere_ / limit);  // colours found everywhere change the odds less
  match.odds = std::exp2(power * (kEvenDistance - match.distance / limit) / kHalvingDistance);
  return match;
}

bool ReferenceAppearance::isDistinct(const AppearanceParams& params) const {
  return kLimitPart * elsewhere_ >= params.min_distance;
}

bool ReferenceAppearance::adapt(const cv::Mat& image, const Quadrilateral& opening, double rate,
                                const AppearanceParams& params) {
  const auto match = compare(image, opening, params);
  if (!match || !match->isLike() || !(rate > 0.0)) return false;
  const RingColours before = adapted_ ? *adapted_ : *colours_;
  const RingColours view = *ringColours(image, opening, kMinBandPixels);
  double part = std::min(rate, 1.0);
  RingColours after = blended(before, view, part);
  for (int halvings = 0; bhattacharyya(*colours_, after) > kMaxDrift; ++halvings) {
    if (halvings == 8) return false;
    after = blended(before, view, part *= 0.5);
  }
  adapted_ = std::make_shared<RingColours>(after);
  return true;
}

double ReferenceAppearance::drift() const { return adapted_ ? bhattacharyya(*colours_, *adapted_) : 0.0; }

}  // namespace window_ingress::detection
