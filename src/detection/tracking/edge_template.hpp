#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "detection/borders/edge_profiles.hpp"
#include "detection/borders/lines.hpp"

namespace window_ingress::detection {

/// Appearance across one border of the tracked window: its change of colour with polarity, and the other
/// edges near it. A frame has two parallel borders of similar colours, and so has a hole in a thick wall. The
/// whole pattern distinguishes them, so that a track cannot slip from one to the other.
class EdgeTemplate {
 public:
  static constexpr int kMaxHalf = 24;   ///< furthest offset remembered [px]
  static constexpr int kMaxReach = 64;  ///< of a search [px]

  struct Match {
    OffsetLine line;          ///< to a pixel, in the profiles' axes
    double similarity = 0.0;  ///< mean correlation along it, -1 to 1
  };

  void clear() { known_ = false; }
  bool known() const { return known_; }

  /// Finds the remembered pattern at most `reach_px` from the profiles' middle line, with a slight preference
  /// for that line. \param size_px size of the window now, measured as in `learn`
  /// \return nothing if nothing is known or less than half of a side's profiles lie in the image
  std::optional<Match> match(const EdgeProfiles& profiles, int reach_px, double size_px) const;

  /// Stores the pattern along a fitted border. \param half_px offsets to remember
  /// \param rate part of the memory that is replaced, 1 for all
  void learn(const EdgeProfiles& profiles, const OffsetLine& border, int half_px, double size_px,
             double rate);

  /// Direction of the border's change in colour space, outwards; unit vector.
  const Eigen::Vector3f& colour() const { return colour_; }

 private:
  using Pattern = std::array<float, 3 * (2 * kMaxHalf + 1)>;
  Pattern zoomed(double zoom) const;

  bool known_ = false;
  int channels_ = 1, half_ = 0;
  double size_px_ = 1.0;
  Pattern slopes_{};  // channel by channel, 2 half + 1 each
  Eigen::Vector3f colour_ = Eigen::Vector3f::UnitX();
};

}  // namespace window_ingress::detection
