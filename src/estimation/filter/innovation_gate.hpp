#pragma once

#include "estimation/filter/window_hypothesis.hpp"
#include "window_ingress/estimation/filter_params.hpp"

namespace window_ingress::estimation {

/// Whether an image that was applied is near enough to what the belief expected.
inline bool passesGate(const std::optional<WindowHypothesis::Outcome>& outcome, const FilterParams& params) {
  return outcome && outcome->squares <= params.nis_gate;
}

}  // namespace window_ingress::estimation
