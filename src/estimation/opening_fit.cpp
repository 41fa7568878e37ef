#include "window_ingress/estimation/opening_fit.hpp"

#include <cmath>

#include "window_ingress/text/text.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kFitSigmas = 2.0;

struct Side {
  const char* name;
  double size_m, sigma_m, needed_m;
  double excess() const { return size_m - needed_m; }
};

std::string text(const Side& side, const char* relation) {
  return formatted("%s %.3f m +- %.3f %s %.3f m that are needed", side.name, side.size_m, side.sigma_m,
                   relation, side.needed_m);
}

}  // namespace

const char* toString(Fit fit) {
  constexpr const char* kNames[] = {"UNKNOWN", "GO", "NO_GO"};
  return kNames[static_cast<std::size_t>(fit)];
}

FitVerdict fitVerdict(const SizeEstimate& opening, const geometry::OpeningSize& needed) {
  if (!isUsable(opening)) return {Fit::kUnknown, "the size of the opening is not known"};
  const auto& [size, covariance] = opening;
  const Side width{"width", size.width_m, size.width_m * std::sqrt(covariance(0, 0)), needed.width_m};
  const Side height{"height", size.height_m, size.height_m * std::sqrt(covariance(1, 1)), needed.height_m};
  const Side& tighter = width.excess() < height.excess() ? width : height;
  for (const Side& side : {tighter, width, height})
    if (side.excess() < -kFitSigmas * side.sigma_m) return {Fit::kNoGo, text(side, "is less than the")};
  for (const Side& side : {tighter, width, height})
    if (!(side.excess() > kFitSigmas * side.sigma_m))
      return {Fit::kUnknown, text(side, "is not certain to be more or less than the")};
  return {Fit::kGo, text(tighter, "is more than the")};
}

}  // namespace window_ingress::estimation
