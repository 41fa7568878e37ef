#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "detection/borders/edge_profiles.hpp"
#include "detection/borders/robust_line_fit.hpp"

namespace window_ingress::detection {

/// How one border of the tracked window looks across: its change of colour with its polarity, and the other
/// edges near it. A frame has two parallel borders of like colours, a hole in a thick wall too; the pattern
/// as a whole tells which of them is which, so that a track cannot slip from one to the other.
class EdgeTemplate {
 public:
  static constexpr int kMaxHalf = 24;  ///< furthest offset that is remembered [px]

  struct Match {
    OffsetLine line;          ///< to a pixel, in the profiles' axes
    double similarity = 0.0;  ///< mean correlation along it, -1 to 1
  };

  void clear() { known_ = false; }
  bool known() const { return known_; }

  /// Where along the profiles the remembered pattern lies: at most `reach_px` from their middle line, which
  /// is preferred by a little. \param size_px of the window now, in the measure that was used in learning
  /// \return nothing if nothing is known or less than half of a side's profiles lie in the image
  std::optional<Match> match(const EdgeProfiles& profiles, int reach_px, double size_px) const;

  /// Takes the pattern along a fitted border into memory. \param half_px offsets to remember
  /// \param rate part of the memory that is replaced, 1 for all
  void learn(const EdgeProfiles& profiles, const OffsetLine& border, int half_px, double size_px,
             double rate);

  /// Direction of its change in colour space, rising outwards; unit vector.
  const Eigen::Vector3f& colour() const { return colour_; }

 private:
  using Pattern = std::array<float, 3 * (2 * kMaxHalf + 1)>;
  Pattern zoomed(double zoom) const;
  void summarise();

  bool known_ = false;
  int channels_ = 1, half_ = 0;
  double size_px_ = 1.0;
  Pattern slopes_{};  // channel by channel, 2 half + 1 each
  Eigen::Vector3f colour_ = Eigen::Vector3f::UnitX();
};

}  // namespace window_ingress::detection
