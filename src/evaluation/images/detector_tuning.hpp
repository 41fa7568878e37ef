#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "evaluation/images/labelled_image.hpp"

namespace window_ingress::evaluation {

struct TuningOptions {
  /// Fields of `DetectorParams` that may be changed, by their full names.
  std::vector<std::string> names;
  int trials = 120;  ///< number of settings tried
  std::uint32_t seed = 1;
};

/// The fields with the largest effect on detection: thresholds of edges, lines and shape, and the least
/// scores.
std::vector<std::string> usualFields();

/// Called after each trial with the number of trials done and the best result so far on the tuning images.
using TuningProgress = std::function<void(int done, const DetectionCounts& best)>;

/// Random coordinate search: moves one field at a time, keeps the move if the merit grows, and repeats moves
/// that worked. At the end, changes without effect on the merit are undone. Deterministic.
/// \return settings at least as good on these images as `start`
/// \throws std::invalid_argument for an unknown name or an empty list of images
detection::DetectorParams tuneDetector(const std::vector<LabelledImage>& samples,
                                       const detection::DetectorParams& start,
                                       const detection::ReferenceAppearance* reference,
                                       const TuningOptions& options, const TuningProgress& progress);

}  // namespace window_ingress::evaluation
