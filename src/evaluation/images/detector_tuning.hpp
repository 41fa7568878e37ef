#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "evaluation/images/labelled_image.hpp"

namespace window_ingress::evaluation {

struct TuningOptions {
  /// Fields of `DetectorParams` that may be changed, by their whole names.
  std::vector<std::string> names;
  int trials = 120;  ///< settings that are tried
  std::uint32_t seed = 1;
};

/// The fields that decide most about what is found: thresholds of edges, lines and shape, and the least
/// scores.
std::vector<std::string> usualFields();

/// Called after each trial: how many are done, and the best so far on the images tuned on.
using TuningProgress = std::function<void(int done, const DetectionCounts& best)>;

/// Random coordinate search: one field after the other is moved, and the move kept if the merit grows; what
/// worked is repeated. In the end each change without which the merit is the same is taken back.
/// Deterministic. \return settings at least as good on these images as `start` \throws
/// std::invalid_argument for a name that is none, or an empty list of images
detection::DetectorParams tuneDetector(const std::vector<LabelledImage>& samples,
                                       const detection::DetectorParams& start,
                                       const detection::ReferenceAppearance* reference,
                                       const TuningOptions& options, const TuningProgress& progress);

}  // namespace window_ingress::evaluation
