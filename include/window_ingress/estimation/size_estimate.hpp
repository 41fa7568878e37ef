#pragma once

#include <Eigen/Core>
#include <string>

#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::estimation {

/// Estimate of the opening's size: log width and log height are normally distributed about those of `size`. A
/// single image measures their ratio, never their common scale.
struct SizeEstimate {
  geometry::OpeningSize size;
  Eigen::Matrix2d log_covariance = Eigen::Matrix2d::Zero();  ///< of (log width, log height); zero: known
};

/// \param scale_sigma relative spread of the common scale; 0: known
/// \param aspect_sigma relative spread of width over height; 0: known
SizeEstimate sizeEstimate(const geometry::OpeningSize& size, double scale_sigma, double aspect_sigma);

/// Finite, positive sizes; a finite covariance without negative variances.
bool isUsable(const SizeEstimate& belief);

/// A with A * A^T = log_covariance: log size = log of `size` + A * z, z of unit variance.
Eigen::Matrix2d rootOf(const SizeEstimate& belief);

/// `size` changed by log deviations.
geometry::OpeningSize scaled(const geometry::OpeningSize& size, const Eigen::Vector2d& log_deviation);

enum class Fit {
  kUnknown,  ///< the size is not known well enough to say
  kGo,       ///< vehicle and margins fit
  kNoGo      ///< vehicle and margins do not fit
};

const char* toString(Fit fit);

struct FitVerdict {
  Fit fit = Fit::kUnknown;
  std::string reason = "no window";  ///< with numbers
};

/// GO if width and height both certainly exceed what the vehicle needs, margins included; NO-GO if either is
/// certainly too small.
FitVerdict fitVerdict(const SizeEstimate& opening, const geometry::OpeningSize& needed);

}  // namespace window_ingress::estimation
