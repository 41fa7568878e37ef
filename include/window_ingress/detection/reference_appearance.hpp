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
  double distance = 0.0;  ///< Bhattacharyya, less what its number of pixels explains; 0 alike to 1 disjoint
  double limit = 1.0;     ///< beyond it this is not the target
  double odds = 1.0;      ///< how much likelier such a distance is for the target than for something else

  bool isLike() const { return distance <= limit; }
};

/// True if no pixel of a grid over the image has a colour: then no comparison of colours means anything.
bool isGrey(const cv::Mat& image);

/// How the target looks (P9): made once from an image of it.
///
/// The limit on the distance comes from the reference image: the distance of nine tenths of the other
/// places in it lies further away. So a frame that stands out may look quite different in another light, and
/// one that hardly differs from what is round it must match well. Where the other places look the same,
/// colour tells nothing, and the odds stay near 1.
class ReferenceAppearance {
 public:
  /// \param image CV_8UC3 (a grey one gives a reference without colour, which rejects nothing)
  /// \param opening inner border of the opening in the image, canonical order; frame and surround lie
  /// outside
  ReferenceAppearance(const cv::Mat& image, const geometry::Quadrilateral& opening);

  /// The whole image is the target with its frame, a twentieth of it wide. Where the opening lies in it is a
  /// guess then, see `openingIsKnown`.
  explicit ReferenceAppearance(const cv::Mat& image);

  /// The same, the opening found by its geometry alone.
  static ReferenceAppearance guessed(const cv::Mat& image, const geometry::Quadrilateral& opening);

  /// False if somebody guessed where the opening is: its colours may be compared, its shape may not.
  bool openingIsKnown() const { return opening_is_known_; }

  /// Why an image with this opening in it cannot be a reference; empty if it can.
  static std::string faultOf(const cv::Mat& image, const geometry::Quadrilateral& opening);

  /// Compares a candidate's ring; nothing if there is no colour to compare.
  std::optional<AppearanceMatch> compare(const cv::Mat& image, const geometry::Quadrilateral& opening,
                                         const AppearanceParams& params) const;

  /// True if its colours are found nowhere else in the reference image, so that they alone can tell it.
  bool isDistinct(const AppearanceParams& params) const;

  static constexpr double kMaxDrift = 0.3;  ///< of `adapt`, Bhattacharyya distance

  /// Moves what the target is taken to look like towards this view of it, while a track is certain. Never
  /// further than `kMaxDrift` from the operator's reference, which stays valid beside it.
  /// \param rate 0 to 1, part of the difference that is taken over
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
  double elsewhere_ = 1.0;  ///< distance that most other places of the image exceed
};

}  // namespace window_ingress::detection
