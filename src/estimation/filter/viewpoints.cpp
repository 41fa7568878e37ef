#include "estimation/filter/viewpoints.hpp"

#include <algorithm>

#include "window_ingress/estimation/filter_params.hpp"

namespace window_ingress::estimation {
namespace {

template <typename Places>
auto nearest(Places& places, const Eigen::Vector3d& position) {
  const auto closer = [&](const auto& a, const auto& b) {
    return (a.position - position).squaredNorm() < (b.position - position).squaredNorm();
  };
  const auto found = std::min_element(places.begin(), places.end(), closer);
  return found != places.end() && (found->position - position).norm() < FilterParams::kSystematicRenewalM
             ? found
             : places.end();
}

}  // namespace

double Viewpoints::looksWith(const Eigen::Vector3d& position) const {
  const auto place = nearest(places_, position);
  return place == places_.end() ? 1.0 : place->looks + 1.0;
}

void Viewpoints::add(const Eigen::Vector3d& position) {
  const auto place = nearest(places_, position);
  if (place != places_.end()) {
    place->looks += 1.0;
    return;
  }
  if (places_.size() == kMaxPlaces) places_.erase(places_.begin());
  places_.push_back({position, 1.0});
}

}  // namespace window_ingress::estimation
