#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Identity of the window. A window keeps its number while it is tracked. After a loss, a found window gets
/// the old number only at the expected place, and only for a while. In a row of equal windows, the neighbour
/// thus gets its own number.
class TrackMemory {
 public:
  static constexpr int kSettled = 5;  ///< tracked frames after which a remembered window is not replaced

  /// \param last number given before
  explicit TrackMemory(const TrackParams& params, std::uint32_t last = 0) : params_(params), id_(last) {}

  std::uint32_t id() const { return id_; }  ///< 0 before the first window

  /// The window is tracked in this frame.
  void follow(double stamp_sec) {
    ++followed_;
    last_sec_ = stamp_sec;
  }

  /// A search found a window: keeps the number for the same window, else takes a new one.
  void found(bool is_same, double stamp_sec) {
    if (!is_same) ++id_, followed_ = 0;
    last_sec_ = stamp_sec;
  }

  /// The window's place is known from elsewhere: waits for it.
  void expect(double stamp_sec) {
    followed_ = std::max(followed_, kSettled);
    last_sec_ = stamp_sec;
  }

  /// Another window is the target from now on.
  void change() { ++id_, forget(); }
  /// True while the old window's place is known well enough to identify it.
  bool remembers(double stamp_sec) const {
    return last_sec_ && stamp_sec - *last_sec_ <= params_.reacquire_sec;
  }

  /// True if the window at `seen` is the one expected at `expected`: its centre within the gate, its size
  /// similar.
  bool isSame(const geometry::Quadrilateral& seen, const geometry::Quadrilateral& expected) const {
    const double a = geometry::rootArea(seen), b = geometry::rootArea(expected);
    const double off = (geometry::centroid(seen) - geometry::centroid(expected)).norm();
    return off < params_.reacquire_gate * std::min(a, b) && std::max(a, b) < kSizeRatio * std::min(a, b);
  }

  /// True if the window was tracked long enough not to be replaced while it is remembered.
  bool settled() const { return followed_ >= kSettled; }
  void forget() { last_sec_.reset(), followed_ = 0; }

 private:
  static constexpr double kSizeRatio = 1.35;  // of one window in two images

  TrackParams params_;
  std::uint32_t id_ = 0;
  int followed_ = 0;
  std::optional<double> last_sec_;  // in view, or where it is expected to be
};

}  // namespace window_ingress::detection
