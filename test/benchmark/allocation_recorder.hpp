/// Records who asks for memory: takes the place of the C library's malloc in the program that it is linked
/// into. Of one thread.
#pragma once

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

namespace window_ingress::bench {

enum class Whose {
  kOurs,    ///< our own code, or a cv::Mat that it makes
  kOpencv,  ///< something inside a function of OpenCV
  kOther    ///< another library
};

const char* toString(Whose whose);

/// Where memory was asked for: "function" of ours, or "function of OpenCV < function of ours that calls it".
struct AllocationSite {
  Whose whose = Whose::kOther;
  std::string where;

  bool operator<(const AllocationSite& other) const {
    return std::tie(whose, where) < std::tie(other.whose, other.where);
  }
};

struct Recording {
  std::vector<AllocationSite> sites;  ///< one an allocation
  std::size_t overflow = 0;           ///< further ones, for which there was no room
  std::size_t bytes = 0;              ///< of all
};

void startRecording();
Recording stopRecording();

}  // namespace window_ingress::bench
