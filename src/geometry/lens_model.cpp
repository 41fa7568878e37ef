#include "window_ingress/geometry/lens_model.hpp"

#include <algorithm>

namespace window_ingress::geometry {
namespace {

bool areZero(std::vector<double>::const_iterator begin, std::vector<double>::const_iterator end) {
  return std::all_of(begin, end, [](double number) { return number == 0.0; });
}

}  // namespace

std::string setLens(const std::string& model, const std::vector<double>& coefficients,
                    PinholeCamera& camera) {
  const bool is_fisheye = model == "equidistant" || model == "fisheye";
  const bool is_plumb_bob = model == "plumb_bob", is_rational = model == "rational_polynomial";
  const std::size_t count = coefficients.size();
  const bool is_straight = areZero(coefficients.begin(), coefficients.end());
  if (model.empty() && is_straight) return "";
  if (!is_fisheye && !is_plumb_bob && !is_rational)
    return "distortion model '" + model.substr(0, 40) +
           "' is not supported, only plumb_bob, equidistant (fisheye) and rational_polynomial; for others "
           "use rectified images (image_proc) and set vehicle/image_is_rectified";
  if (!is_fisheye && is_straight) return "";
  const std::size_t wanted = is_plumb_bob ? 5 : is_rational ? 8 : 4;
  if (count != wanted && !(is_plumb_bob && count == 4))
    return "D holds " + std::to_string(count) + " numbers, " + model + " has " + std::to_string(wanted);
  if (is_rational && !areZero(coefficients.begin() + 5, coefficients.end()))
    return "distortion model rational_polynomial is supported with k4 = k5 = k6 = 0 only; calibrate with "
           "plumb_bob";
  if (is_fisheye) camera.model = LensModel::kEquidistant;
  std::copy_n(coefficients.begin(), std::min(count, camera.distortion.size()), camera.distortion.begin());
  return "";
}

}  // namespace window_ingress::geometry
