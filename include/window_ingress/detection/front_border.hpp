#pragma once

#include <Eigen/Core>
#include <optional>

#include "window_ingress/detection/edge_profiles.hpp"

namespace window_ingress::detection {

/// Keeps a border at the front of the opening while the window comes nearer.
///
/// From afar the two edges of a reveal (front: frame or wall to reveal; back: reveal to what is behind) are
/// one; nearer they part, and the back one is often the stronger. The front one is where the colour outside,
/// that of frame or wall, ends: it was next to the border when the edges were one, and is remembered. When
/// something else has come between the border and that colour, the border is moved out to where it begins.
/// Lines of the wall beyond (courses of bricks, the frame's outer border) are none of that: the remembered
/// colour lies between them and the border.
class FrontBorder {
 public:
  static constexpr int kHalf = 10;  ///< offsets that are looked at [px]

  void forget() { known_ = false; }
  /// Colour next to the border, BGR; null while nothing is known.
  const Eigen::Vector3f* outside() const { return known_ ? &outside_ : nullptr; }

  /// The border lies along this line.
  /// \return how far out the front border is from it, if it is another one; after it was so several times
  std::optional<double> look(const EdgeProfiles& profiles, const OffsetLine& border, int half_px);

 private:
  Eigen::Vector3f likest(const float* mean, int channels, int half) const;
  std::optional<int> partedAt(const float* mean, int channels, int half) const;

  bool known_ = false;
  Eigen::Vector3f outside_ = Eigen::Vector3f::Zero();  // colour next to the border
  int parted_ = 0;                                     // times in a row
};

}  // namespace window_ingress::detection
