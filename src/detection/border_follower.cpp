#include "window_ingress/detection/border_follower.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/detection/colour_sharpness.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kNominalSide = 640.0;  // longer side of a picture at which pixel parameters hold
constexpr double kSkip = 0.06;          // of a side at its ends
constexpr double kViewMarginPx = 3.0;   // of a side from the border of the picture
constexpr double kMostOfASide = 0.8;    // of a short side must be in the picture
constexpr double kSigmas = 3.0;
constexpr double kLeastReachPx = 2.5;
constexpr double kLearningRate = 0.15;  // a picture
constexpr double kPriorPx = 1.0;        // of the border beside stronger edges
constexpr double kRoughPx = 0.7;        // of the first fit
constexpr double kFrontReachPx = 3.2;   // of the front edge of a reveal from what was fitted
constexpr int kLookEvery = 6;           // pictures, for a reveal beside the border
constexpr int kLeastProfiles = 6;

int longerSide(const cv::Mat& image) { return std::max(image.cols, image.rows); }

double scaleOf(const cv::Mat& image) { return std::max(1.0, longerSide(image) / kNominalSide); }

}  // namespace

FollowedBorder BorderFollower::follow(const cv::Mat& image, const geometry::PinholeCamera* lens,
                                      const Stretch& predicted, double size_px, double sigma_px) {
  FollowedBorder border;
  const auto stretch = stretchInView(predicted, image.size(), kViewMarginPx, lens);
  if (!stretch) return border;
  const double wanted = std::min(track_.min_stretch * longerSide(image), kMostOfASide * predicted.length());
  border.in_view = stretch->length() >= wanted && memory_.known();
  if (!border.in_view) return border;
  const double most = std::max(kLeastReachPx, track_.reach * longerSide(image));
  const int reach = static_cast<int>(std::lround(std::clamp(kSigmas * sigma_px + 1.0, kLeastReachPx, most)));
  const int count = std::clamp(static_cast<int>(stretch->length()), kLeastProfiles, track_.profiles);
  coarse_.sample(image, lens, {stretch->from, stretch->to, count, kSkip, reach + half_px_ + 2, true});
  const auto match = memory_.match(coarse_, reach, size_px);
  border.similarity = match ? match->similarity : 0.0;
  border.fitted =
      match && match->similarity >= track_.min_similarity && fit(image, lens, match->line, border);
  return border;
}

bool BorderFollower::fit(const cv::Mat& image, const geometry::PinholeCamera* lens, const OffsetLine& coarse,
                         FollowedBorder& border) {
  const double scale = scaleOf(image), half = 0.5 * coarse_.length(),
               radius_px = scale * refinement_.final_radius_px;
  const int count =
      std::clamp(static_cast<int>(2.0 * half * (1.0 - 2.0 * kSkip)), kLeastProfiles, track_.fine_profiles);
  fine_.sample(image, lens,
               {coarse_.point(-half, coarse.at(-half)), coarse_.point(half, coarse.at(half)), count, kSkip,
                static_cast<int>(std::ceil(radius_px)) + 5});
  if (!soft_) soft_ = isColourSoft(fine_);
  fit_.project(fine_, *soft_ ? resolvedPart(memory_.colour()).normalized() : memory_.colour());
  FittedBorder fitted;
  BorderFitLimits limits{radius_px, kPriorPx * scale, std::max(kRoughPx, refinement_.outlier_px) * scale,
                         refinement_.sigma_floor_px};
  if (!fit_.run(limits, fitted)) return false;
  limits.outlier_px = refinement_.outlier_px * scale;
  if (!fit_.run(limits, fitted)) return false;
  if (edge_.apart > 0.0 || ++frames_ % kLookEvery == 0)
    edge_ = fit_.toFront({-kFrontReachPx, kFrontReachPx, front_.outside(), &edge_}, fitted);
  border.inliers = static_cast<double>(fitted.inliers) / std::max(1, fine_.insideCount());
  border.line = fitted.inImage(fine_);
  border.a = fine_.point(fitted.from, fitted.line.at(fitted.from));
  border.b = fine_.point(fitted.to, fitted.line.at(fitted.to));
  seen_ = {coarse.offset + fitted.line.offset, coarse.slope + fitted.line.slope};
  return border.inliers >= track_.min_inliers;
}

void BorderFollower::keep(const cv::Mat& image, const geometry::PinholeCamera* lens, double size_px) {
  const auto out_px = front_.look(coarse_, seen_, half_px_);
  if (!out_px) return memory_.learn(coarse_, seen_, half_px_, size_px, kLearningRate);
  const double half = 0.5 * coarse_.length();
  learn(image, lens,
        {coarse_.point(-half, seen_.at(-half) + *out_px), coarse_.point(half, seen_.at(half) + *out_px)},
        size_px);
}

void BorderFollower::learn(const cv::Mat& image, const geometry::PinholeCamera* lens, const Stretch& border,
                           double size_px) {
  half_px_ =
      std::clamp(static_cast<int>(std::lround(track_.reach * longerSide(image))), 4, BorderMemory::kMostHalf);
  coarse_.sample(image, lens, {border.from, border.to, track_.profiles, kSkip, half_px_ + 3, true});
  edge_ = DoubleEdge();
  frames_ = -1;
  soft_.reset();
  memory_.clear();
  memory_.learn(coarse_, {}, half_px_, size_px, 1.0);
  front_.forget();
  front_.look(coarse_, {}, half_px_);
}

}  // namespace window_ingress::detection
