/// Records where memory is allocated. It replaces the C library's malloc in the program that links it. For
/// one thread.
#pragma once

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

namespace window_ingress::bench {

enum class Whose {
  kOurs,    ///< our own code, or a cv::Mat that it creates
  kOpencv,  ///< inside a function of OpenCV
  kOther    ///< another library
};

const char* toString(Whose whose);

/// Where memory was allocated: "function" of ours, or "function of OpenCV < function of ours that calls it".
struct AllocationSite {
  Whose whose = Whose::kOther;
  std::string where;

  bool operator<(const AllocationSite& other) const {
    return std::tie(whose, where) < std::tie(other.whose, other.where);
  }
};

struct Recording {
  std::vector<AllocationSite> sites;  ///< one for each allocation
  std::size_t overflow = 0;           ///< allocations for which there was no room
  std::size_t bytes = 0;              ///< of all allocations
};

void startRecording();
Recording stopRecording();

}  // namespace window_ingress::bench
