#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

struct RingColours;

/// One candidate against the reference.
struct AppearanceMatch {
  double distance = 0.0;  ///< Bhattacharyya, less its bias from the number of pixels; 0 alike to 1 disjoint
  double limit = 1.0;     ///< above it the candidate is not the target
  double odds = 1.0;      ///< likelihood ratio of this distance: target over anything else

  bool isLike() const { return distance <= limit; }
};

/// True if no pixel of a grid over the image has a colour, so that comparing colours is meaningless.
bool isGrey(const cv::Mat& image);

/// Appearance of the target (P9), made once from an image of it.
///
/// The limit on the distance comes from the reference image: nine tenths of its other places are further
/// away. So a frame that stands out may look quite different in another light, and a frame that hardly
/// differs from its surroundings must match well. If the other places look the same, colour cannot
/// distinguish the target, and the odds stay near 1.
class ReferenceAppearance {
 public:
  /// \param image CV_8UC3 (a grey image gives a reference without colour, which rejects nothing)
  /// \param opening inner border of the opening in the image, canonical order; frame and surround lie
  /// outside
  ReferenceAppearance(const cv::Mat& image, const geometry::Quadrilateral& opening);

  /// The whole image counts as the target with its frame, assumed a twentieth of the image wide. The place of
  /// the opening is then a guess, see `openingIsKnown`.
  explicit ReferenceAppearance(const cv::Mat& image);

  /// The same, with the opening found by its geometry alone.
  static ReferenceAppearance guessed(const cv::Mat& image, const geometry::Quadrilateral& opening);

  /// False if the place of the opening is a guess: its colours may be compared, its shape may not.
  bool openingIsKnown() const { return opening_is_known_; }

  /// Why an image with this opening in it cannot be a reference; empty if it can.
  static std::string faultOf(const cv::Mat& image, const geometry::Quadrilateral& opening);

  /// Compares a candidate's ring; nothing if there is no colour to compare.
  std::optional<AppearanceMatch> compare(const cv::Mat& image, const geometry::Quadrilateral& opening,
                                         const AppearanceParams& params) const;

  /// True if its colours occur nowhere else in the reference image, so that they alone identify the target.
  bool isDistinct(const AppearanceParams& params) const;

  static constexpr double kMaxDrift = 0.3;  ///< of `adapt`, Bhattacharyya distance

  /// Adapts the expected appearance towards this view of the target, while a track is certain. It stays
  /// within `kMaxDrift` of the operator's reference, which remains valid, too.
  /// \param rate 0 to 1, part of the difference that is adopted
  /// \return false, and nothing changed, if the view cannot be compared or is not like the target
  bool adapt(const cv::Mat& image, const geometry::Quadrilateral& opening, double rate,
             const AppearanceParams& params);

  /// Distance of the adapted appearance from the operator's reference; 0 before the first adaptation.
  double drift() const;

  const cv::Mat& image() const { return image_; }
  const geometry::Quadrilateral& opening() const { return opening_; }

 private:
  cv::Mat image_;
  geometry::Quadrilateral opening_;
  bool opening_is_known_ = true;
  std::shared_ptr<const RingColours> colours_, adapted_;
  double elsewhere_ = 1.0;  ///< distance exceeded by most other places of the image
};

}  // namespace window_ingress::detection
