#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "detection/reference/side_profile.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Which of the borders that lie in each other, frame's outer and inner one, far edge of the reveal, panes,
/// is the front inner border of the opening: side by side the one from which outwards the colours follow each
/// other as they do in the reference image. Frame and wall lie in the plane of the opening, so that the
/// order and the widths of their colours are the same from any direction; what is seen through the opening is
/// not looked at.
class ReferenceBorders {
 public:
  static constexpr int kBands = 7;            ///< outwards from the border
  static constexpr double kBandWidth = 0.02;  ///< [mean sides of the opening]

  static constexpr double kSureWorth = 0.3;  ///< of borders that are surely the reference's

  /// \param opening inner border in the image, canonical order. Without colour nothing is learned.
  void learn(const cv::Mat& image, const geometry::Quadrilateral& opening);
  void forget() { known_ = false; }
  bool known() const { return known_; }

  /// True if the reference shows no frame: then there are no colours to go by, see `RingMatcher`.
  bool frameless() const { return known_ && frameless_; }

  /// Samples along a side and across it.
  struct Effort {
    int along, across;
  };
  static constexpr Effort kCoarse = {8, 64}, kFine = {24, 140};

  struct Located {
    geometry::Quadrilateral
        quad;  ///< pixels of the image as it came; each side to two pixels or so, for the fit to start from
    double worth = 0.0;  ///< geometric mean of the least alike side and all: 0 unlike the reference to 1
  };
  /// \param rough some loop of the window, pixels of the image as it came
  /// \return nothing if there is no colour, or a side has no edge at all
  std::optional<Located> locate(const cv::Mat& image, const geometry::Quadrilateral& rough,
                                const geometry::PinholeCamera* camera, const Effort& effort);

 private:
  using Bands = std::array<Eigen::Vector3f, kBands>;

  void measure(const cv::Mat& image, const geometry::Quadrilateral& ideal,
               const geometry::PinholeCamera* lens, const Effort& effort);
  static bool coloursFrom(const SideProfile& profile, double border, Bands& colours);
  static Bands featuresOf(const Bands& colours);
  double unlike(const Bands& colours, int side) const;
  double unlikeThroughHaze(const Bands& colours, int side) const;
  double choose(int side, double& border) const;
  double frameEnds(int side, double border) const;

  bool known_ = false;
  double aspect_ = 1.0;  ///< of the opening: width over height
  /// Of each side: red and green chromaticity, logarithm of the brightness over that of the outermost band.
  std::array<Bands, 4> reference_;
  std::array<Bands, 4> reference_colours_;  ///< BGR
  std::array<double, 4> frame_widths_{};    ///< [mean sides of the opening]; 0: no end seen
  bool frameless_ = false;
  std::array<SideProfile, 4> sides_;
  float darkest_ = 0.0F;  ///< least channel in them
};

}  // namespace window_ingress::detection
