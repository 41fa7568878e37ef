#pragma once

#include <cstddef>
#include <deque>

namespace window_ingress::estimation {

/// How well the images of late agree with what the filter expected of them.
struct Consistency {
  int images = 0;  ///< that the figures rest on
  /// Mean normalised innovation squared a degree of freedom: 1 is expected where all noise is white, less
  /// where errors last, more where they are larger than stated.
  double mean_nis = 0.0;
  bool consistent = true;  ///< mean_nis does not exceed its limit, or too few images are there to say
  int refused = 0;         ///< images beside those, that contradicted what the filter expected
  /// More than two of five are refused: the filter follows what is not there. False where too few images are
  /// there to say. With window, camera and odometry as they are said to be, one in ten at most is refused.
  bool contradicted = false;
};

/// Normalised innovation squared (NIS) over a sliding window of images.
///
/// Errors of neighbouring images are alike (the systematic one lasts), so the mean of a window scatters as
/// one image in the worst case. The limit is therefore that of a single image: 3.3 a degree of freedom is
/// the 99.9 % point of chi squared with eight of them.
class ConsistencyMonitor {
 public:
  static constexpr int kImages = 50;          ///< of the window
  static constexpr double kMaxMeanNis = 3.3;  ///< a degree of freedom
  explicit ConsistencyMonitor(int images = kImages) : images_(static_cast<std::size_t>(images)) {}

  void add(double squares, int degrees_of_freedom);
  void refuse();  ///< an image that the filter did not use
  void clear() { samples_.clear(); }
  Consistency consistency() const;

 private:
  struct Sample {
    double squares;
    int degrees_of_freedom;  ///< 0: refused
  };
  void note(const Sample& sample);
  std::size_t images_;
  std::deque<Sample> samples_;
};

}  // namespace window_ingress::estimation
