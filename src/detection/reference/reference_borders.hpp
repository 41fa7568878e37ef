#pragma once

#include <optional>

#include "detection/reference/side_profile.hpp"

namespace window_ingress::detection {

/// Finds the front inner border of the opening among nested borders: outer and inner border of the frame, far
/// edge of the reveal, panes. Each side is placed at the edge whose outward colour sequence best matches the
/// reference image. Frame and wall lie in the plane of the opening, so the order and widths of their colours
/// are the same from any direction. What is seen through the opening does not count.
class ReferenceBorders {
 public:
  static constexpr int kBands = 7;  ///< outwards from the border
  using Bands = std::array<Eigen::Vector3f, kBands>;
  static constexpr double kSureBorderScore = 0.3;  ///< score of borders that surely match the reference

  /// \param opening inner border in the image, canonical order. Without colour nothing is learned.
  void learn(const cv::Mat& image, const geometry::Quadrilateral& opening);
  bool known() const { return known_; }

  /// True if the reference shows no frame. Then its colours do not help, see `RingMatcher`.
  bool frameless() const { return known_ && frameless_; }

  /// Samples along a side and across it.
  struct Effort {
    int along, across;
  };
  static constexpr Effort kCoarse = {8, 64}, kFine = {24, 140};

  struct Located {
    geometry::Quadrilateral quad;  ///< raw pixels; sides accurate to about two pixels, a start for the fit
    double border_score = 0.0;     ///< geometric mean of the worst side's and the mean score, 0 to 1
  };
  /// \param rough quadrilateral of the window, raw pixels
  /// \return nothing if there is no colour, or a side has no edge at all
  std::optional<Located> locate(const cv::Mat& image, const geometry::Quadrilateral& rough,
                                const geometry::PinholeCamera* camera, const Effort& effort);

 private:
  double unlikeThroughHaze(const Bands& colours, int side) const;
  double choose(int side, double& border) const;
  double frameEnds(int side, double border) const;

  bool known_ = false;
  double aspect_ = 1.0;  ///< of the opening: width over height
  /// Per side: red and green chromaticity, logarithm of brightness relative to the outermost band.
  std::array<Bands, 4> reference_;
  std::array<Bands, 4> reference_colours_;  ///< BGR
  std::array<double, 4> frame_widths_{};    ///< [mean sides of the opening]; 0: no end seen
  bool frameless_ = false;
  std::array<SideProfile, 4> sides_;
  float darkest_ = 0.0F;  ///< least channel in `sides_`
};

}  // namespace window_ingress::detection
