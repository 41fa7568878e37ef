/// What is measured, each by the same name in every measurement.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "frame_set.hpp"

namespace window_ingress::bench {

/// Handles one image, the next of its sequence, to and fro. \return whether it found something; of `track`:
/// whether it followed the window without a search
using Step = std::function<bool()>;

/// The number of the next image: 0, 1, .. n-1, n-2, .. 0, and so on, so that the camera never jumps.
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
  /// Step over a sequence, all made that can be made beforehand; empty: the subject does not apply to it.
  /// The sequence must outlive the step.
  std::function<Step(const Sequence&)> start;
};

std::vector<Subject> ownSubjects();   ///< search, track
std::vector<Subject> ownStages();     ///< the stages of the search, each on what those before it gave
std::vector<Subject> peerSubjects();  ///< composition, composition_without_hough
std::vector<Subject>
markerSubjects();  ///< apriltag_decimate_2, apriltag_decimate_1, aruco: those that are installed

/// All of them.
std::vector<Subject> allSubjects();

}  // namespace window_ingress::bench
