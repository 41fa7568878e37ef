#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

struct ReferenceBordersParams {
  double inward = 0.12;         ///< borders are looked for so far inside a rough loop, in mean sides of it
  double outward = 0.22;        ///< and so far outside
  double alike = 0.10;          ///< difference of colours from the reference's that takes e-fold off a border's worth
  double contrast_full = 10.0;  ///< change of the mean colour over two pixels that counts fully [grey levels]
  double brightness_weight = 0.25;  ///< of relative brightness beside chroma

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("inward", self.inward, 0.0, 0.4);
    field("outward", self.outward, 0.0, 0.6);
    field("alike", self.alike, 0.001, 10.0);
    field("contrast_full", self.contrast_full, 0.1, 255.0);
    field("brightness_weight", self.brightness_weight, 0.0, 10.0);
  }
};

/// Colours across one side of a loop, from the inside outwards: means along the side.
struct SideProfile {
  double first = 0.0;  ///< distance of the first mean from the loop, outwards positive [mean sides of the opening]
  double step = 0.0;   ///< between two means
  std::vector<Eigen::Vector3f> means;  ///< BGR

  double at(int i) const { return first + i * step; }
};

/// Which of the borders that lie in each other, frame's outer and inner one, far edge of the reveal, panes, is the
/// front inner border of the opening: side by side the one from which outwards the colours follow each other as
/// they do in the reference picture. Frame and wall lie in the plane of the opening, so that the order and the
/// widths of their colours are the same from any direction; what is seen through the opening is not looked at.
class ReferenceBorders {
 public:
  static constexpr int kBands = 7;  ///< outwards from the border
  static constexpr double kBandWidth = 0.02;  ///< [mean sides of the opening]

  explicit ReferenceBorders(const ReferenceBordersParams& params) : params_(params) {}

  /// \param opening inner border in the picture, canonical order. Without colour nothing is learned.
  void learn(const cv::Mat& picture, const geometry::Quadrilateral& opening);
  void forget() { known_ = false; }
  bool known() const { return known_; }

  struct Located {
    geometry::Quadrilateral quad;  ///< pixels of the image as it came; to a pixel
    double worth = 0.0;            ///< of the least alike side: 0 unlike the reference to 1
  };
  /// \param rough some loop of the window, pixels of the image as it came
  /// \return nothing if there is no colour, or a side has no edge at all
  std::optional<Located> locate(const cv::Mat& image, const geometry::Quadrilateral& rough,
                                const geometry::PinholeCamera* camera);

 private:
  using Bands = std::array<Eigen::Vector3f, kBands>;

  void measure(const cv::Mat& image, const geometry::Quadrilateral& ideal, const geometry::PinholeCamera* lens,
               double aspect);
  bool bandsFrom(const SideProfile& profile, double border, Bands& bands) const;
  double unlike(const Bands& bands) const;
  double choose(const SideProfile& profile, double& border) const;

  ReferenceBordersParams params_;
  bool known_ = false;
  double aspect_ = 1.0;  ///< of the opening: width over height
  Bands reference_;      ///< red and green chromaticity, logarithm of the brightness over that of the outermost
  std::array<SideProfile, 4> sides_;
};

}  // namespace window_ingress::detection
