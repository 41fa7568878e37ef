#include "detection/tracking/appearance_monitor.hpp"

#include <algorithm>
#include <utility>

#include "detection/quads.hpp"
#include "detection/tracking/image_sequence.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kAdaptation = 0.1;  ///< part of a difference in appearance that a comparison takes over
constexpr double kRingPx = 100.0;    // resolution of a ring [px a mean side]
constexpr int kAlignEvery = 3;       // frames
constexpr double kMinStrayPx = 3.0, kStray = 0.03;  // of a corner from there; in the window's sizes

}  // namespace

void AppearanceMonitor::setParams(const DetectorParams& params) {
  params_ = params;
  learnBorders();
}

void AppearanceMonitor::setReference(std::shared_ptr<ReferenceAppearance> reference) {
  reference_ = std::move(reference);
  learnBorders();
}

void AppearanceMonitor::learnBorders() {
  borders_.reset();
  if (!reference_) return;
  borders_ = std::make_unique<ReferenceBorders>();
  borders_->learn(reference_->image(), reference_->opening());
  ring_.forget();
  if (reference_->openingIsKnown()) ring_.learn(reference_->image(), reference_->opening());
}

void AppearanceMonitor::start() {
  restart();
  frames_to_comparison_ = params_.track.appearance_every;
}

std::optional<geometry::Quadrilateral> AppearanceMonitor::align(const TrackInput& input,
                                                                const geometry::Quadrilateral& followed) {
  if (!ring_.known() || input.image.channels() != ring_.channels() || --frames_to_alignment_ > 0)
    return std::nullopt;
  frames_to_alignment_ = kAlignEvery;
  alignment_.set(ring_, input.image, input.camera);
  const auto found = alignment_.align(followed, kRingPx);
  if (!found || found->match.correlation < params_.min_correlation) return std::nullopt;
  if (borders_->frameless()) return found->quad;
  const auto located = borders_->locate(input.image, found->quad, input.camera, ReferenceBorders::kFine);
  if (!located || located->worth < ReferenceBorders::kSureWorth) return std::nullopt;
  if (furthestCorner(located->quad, followed) <= std::max(kMinStrayPx, kStray * sizeOf(followed)))
    return std::nullopt;
  return located->quad;
}

bool AppearanceMonitor::strays(const TrackInput& input, const geometry::Quadrilateral& followed) {
  if (borders_->frameless()) return false;
  const auto found = borders_->locate(input.image, followed, input.camera, ReferenceBorders::kFine);
  if (!found || found->worth < ReferenceBorders::kSureWorth) return false;
  return furthestCorner(found->quad, followed) > std::max(kMinStrayPx, kStray * sizeOf(followed));
}

bool AppearanceMonitor::look(const TrackInput& input, const geometry::Quadrilateral& followed,
                             WindowObservation& window) {
  agreed_ = compared_ = false;
  if (!reference_ || --frames_to_comparison_ > 0) return true;
  frames_to_comparison_ = params_.track.appearance_every;
  const bool in_place = !strays(input, followed);
  if (!window.whole()) return in_place;
  const auto match = reference_->compare(input.image, window.corners, params_.appearance);
  window.has_appearance = match.has_value();
  window.bhattacharyya = match ? match->distance : 0.0;
  compared_ = window.has_appearance;
  unlike_ = match && !match->isLike();
  agreed_ = match && !unlike_;
  return in_place && !unlike_;
}

void AppearanceMonitor::adapt(const TrackInput& input, const WindowObservation& window) {
  reference_->adapt(input.image, window.corners, kAdaptation, params_.appearance);
}

}  // namespace window_ingress::detection
