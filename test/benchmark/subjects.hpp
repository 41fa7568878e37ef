/// The measured subjects, with the same names in every measurement.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "frame_set.hpp"

namespace window_ingress::bench {

/// Processes one image, the next of its sequence, forwards and backwards. \return whether it found something;
/// for `track`: whether it tracked the window without a search
using Step = std::function<bool()>;

/// Index of the next image: 0, 1, .. n-1, n-2, .. 0, and so on, so that the camera never jumps.
class ToAndFro {
 public:
  explicit ToAndFro(std::size_t count) : count_(count) {}
  std::size_t next();

 private:
  std::size_t count_, at_ = 0;
  bool back_ = false;
};

struct Subject {
  std::string name;
  /// A step over a sequence, with everything prepared in advance; empty if the subject does not apply to it.
  /// The sequence must outlive the step.
  std::function<Step(const Sequence&)> start;
};

std::vector<Subject> ownSubjects();   ///< search, track
std::vector<Subject> ownStages();     ///< stages of the search, each with the results of those before it
std::vector<Subject> peerSubjects();  ///< composition, composition_without_hough
std::vector<Subject>
markerSubjects();  ///< apriltag_decimate_2, apriltag_decimate_1, aruco: those that are installed

/// All subjects.
std::vector<Subject> allSubjects();

}  // namespace window_ingress::bench
