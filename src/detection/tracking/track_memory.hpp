#pragma once

#include <algorithm>
#include <cstdint>

#include "detection/quads.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Which window it is. A number stays with a window while it is tracked; after a loss, the window found gets
/// the old number only where the old one must be by now, and only for a while; in a row of equal windows the
/// neighbour gets a number of its own.
class TrackMemory {
 public:
  static constexpr int kSettled =
      5;  ///< frames after which a lost window is waited for before another one is taken

  /// \param last number that was given before
  explicit TrackMemory(const TrackParams& params, std::uint32_t last = 0) : params_(params), id_(last) {}

  std::uint32_t id() const { return id_; }  ///< 0 before the first window

  /// The window is followed in this frame.
  void follow(double stamp_sec) {
    known_ = true;
    ++followed_;
    last_sec_ = stamp_sec;
  }

  /// A search found a window: the old number if it is the old window, else a new one.
  void found(bool is_same, double stamp_sec) {
    if (!is_same) ++id_, followed_ = 0;
    known_ = true;
    last_sec_ = stamp_sec;
  }

  /// Something else knows where the window is: it is waited for.
  void expect(double stamp_sec) {
    known_ = true;
    followed_ = std::max(followed_, kSettled);
    last_sec_ = stamp_sec;
  }

  /// Another window is to be found from here on.
  void change() { ++id_, forget(); }
  /// The place of the old window is still known well enough to say which one it is.
  bool remembers(double stamp_sec) const { return known_ && stamp_sec - last_sec_ <= params_.reacquire_sec; }

  /// Whether a window seen at `seen` is the one that must be at `expected`: its centre within the gate, its
  /// size like it.
  bool isSame(const geometry::Quadrilateral& seen, const geometry::Quadrilateral& expected) const {
    const double a = sizeOf(seen), b = sizeOf(expected);
    const double off = (geometry::centroid(seen) - geometry::centroid(expected)).norm();
    return off < params_.reacquire_gate * std::min(a, b) && std::max(a, b) < kSizeRatio * std::min(a, b);
  }

  /// It was followed for so long that another window is not taken in its place while it is remembered.
  bool settled() const { return followed_ >= kSettled; }
  void forget() { known_ = false, followed_ = 0; }

 private:
  static constexpr double kSizeRatio = 1.35;  // of one window in two images

  TrackParams params_;
  std::uint32_t id_ = 0;
  bool known_ = false;
  int followed_ = 0;
  double last_sec_ = 0.0;
};

}  // namespace window_ingress::detection
