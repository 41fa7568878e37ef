#include "window_ingress/perception/window_perception.hpp"

namespace window_ingress::perception {

WindowPerception::WindowPerception(const detection::DetectorParams& detector,
                                   const openness::InteriorKltParams& interior)
    : tracker_(detector), interior_(interior) {}

const std::optional<detection::WindowObservation>& WindowPerception::update(
    const detection::TrackInput& frame) {
  window_ = tracker_.update(frame);
  if (window_) interior_.follow(frame.image, *window_);
  return window_;
}

void WindowPerception::reset() {
  tracker_.reset();
  interior_.reset();
  window_.reset();
}

}  // namespace window_ingress::perception
