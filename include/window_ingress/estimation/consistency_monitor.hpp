#pragma once

#include <cstddef>
#include <deque>

namespace window_ingress::estimation {

/// How well recent images agree with the filter's predictions.
struct Consistency {
  int images = 0;  ///< number of images behind the figures
  /// Mean normalised innovation squared per degree of freedom: 1 is expected if all noise is white, less if
  /// errors are systematic, more if they are larger than stated.
  double mean_nis = 0.0;
  bool consistent = true;  ///< mean_nis is within its limit, or there are too few images to tell
  int refused = 0;         ///< further images, refused because they contradicted the prediction
  /// More than two of five images are refused: the filter tracks something that is not there. False if there
  /// are too few images to tell. If window, camera and odometry are as configured, at most one in ten is
  /// refused.
  bool contradicted = false;
};

/// Normalised innovation squared (NIS) over a sliding window of images.
///
/// Errors of neighbouring images are similar (the systematic part lasts), so in the worst case the mean
/// scatters like a single image. The limit is therefore that of a single image: 3.3 per degree of freedom is
/// the 99.9 % point of chi squared with eight degrees of freedom.
class ConsistencyMonitor {
 public:
  static constexpr int kImages = 50;          ///< length of the window
  static constexpr double kMaxMeanNis = 3.3;  ///< per degree of freedom

  void add(double squares, int degrees_of_freedom);
  void refuse() { note({0.0, 0}); }  ///< an image that the filter did not use
  void clear() { samples_.clear(); }
  Consistency consistency() const;

 private:
  struct Sample {
    double squares;
    int degrees_of_freedom;  ///< 0: refused
  };
  void note(const Sample& sample);
  std::deque<Sample> samples_;
};

}  // namespace window_ingress::estimation
