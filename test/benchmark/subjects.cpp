#include "subjects.hpp"

#include <memory>

#include "opencv_composition.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/detection/window_tracker.hpp"

namespace window_ingress::bench {
namespace {

Step search(const Sequence& sequence) {
  auto detector = std::make_shared<detection::WindowDetector>(detection::DetectorParams());
  if (sequence.reference) detector->setReference(*sequence.reference);
  return [&sequence, detector, order = ToAndFro(sequence.images.size())]() mutable {
    return detector->detect(sequence.images[order.next()], 0.0, sequence.cameraOrNull()).has_value();
  };
}

/// An image in which the window was tracked has no contours and segments, because nothing was searched.
Step track(const Sequence& sequence) {
  auto tracker = std::make_shared<detection::WindowTracker>(detection::DetectorParams());
  if (sequence.reference) tracker->setReference(*sequence.reference);
  detection::TrackInput input;
  input.camera = sequence.cameraOrNull();
  return [&sequence, tracker, input, order = ToAndFro(sequence.images.size())]() mutable {
    input.image = sequence.images[order.next()];
    input.stamp_sec += sequence.period_sec;
    const bool seen = tracker->update(input).has_value();
    return seen && tracker->trace().contours + tracker->trace().segments == 0;
  };
}

Step composition(const Sequence& sequence, bool with_hough) {
  auto peer = std::make_shared<test::OpencvComposition>(with_hough);
  if (sequence.reference) {
    std::vector<cv::Point> opening;
    for (const auto& corner : sequence.reference->opening())
      opening.emplace_back(cvRound(corner.x()), cvRound(corner.y()));
    peer->setReference(sequence.reference->image(), opening);
  }
  return [&sequence, peer, order = ToAndFro(sequence.images.size())]() mutable {
    return !peer->run(sequence.images[order.next()]).empty();
  };
}

}  // namespace

std::size_t ToAndFro::next() {
  const std::size_t now = at_;
  if (now + 1 >= count_) back_ = true;
  if (now == 0) back_ = false;
  if (count_ > 1) at_ = back_ ? now - 1 : now + 1;
  return now;
}

std::vector<Subject> ownSubjects() { return {{"search", search}, {"track", track}}; }

std::vector<Subject> peerSubjects() {
  return {{"composition", [](const Sequence& s) { return composition(s, true); }},
          {"composition_without_hough", [](const Sequence& s) { return composition(s, false); }}};
}

std::vector<Subject> allSubjects() {
  std::vector<Subject> all;
  for (const auto& some : {ownSubjects(), peerSubjects(), markerSubjects(), ownStages()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace window_ingress::bench
