#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/reference_appearance.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::evaluation {

/// An image with the true place of the opening.
struct LabelledImage {
  std::string group;  ///< images that look alike, such as neighbours in a video, share a group
  cv::Mat image;      ///< CV_8UC1 or CV_8UC3
  std::vector<geometry::Quadrilateral> targets;  ///< inner borders; any of them may be found; none: no window
  std::optional<geometry::PinholeCamera> camera;
};

/// Results of the detector on several images. Found: a detection whose overlap with a target is at least
/// `kSameWindowIou`; any other detection is wrong.
struct DetectionCounts {
  int found = 0, missed = 0, wrong = 0;  ///< `found` and `missed` count images with a target
  double overlap = 0.0;                  ///< sum of the overlaps of the found ones

  double f1() const;  ///< harmonic mean of recall and precision
  /// Merit for the search: `f1` plus a small share for better corners.
  double merit() const;
  /// "recall 90.0 % (74.4 to 96.5 %, 27 of 30), precision ..." with 95 % Wilson intervals
  std::string text() const;
};

DetectionCounts countDetections(const std::vector<LabelledImage>& samples,
                                const detection::DetectorParams& params,
                                const detection::ReferenceAppearance* reference);

/// Reads annotations: a csv file with columns file, x1, y1 .. x4, y4, in any order, among others; one row per
/// target, without numbers if the image has none. Labels that begin with "pose_only_" are left out.
/// \param folder where the images are
/// \throws InputError that names the fault and its line
std::vector<LabelledImage> readLabelled(const std::string& csv_file, const std::string& folder);

/// An image of a window whose pose is known. Nothing if the image shows only a part of the window.
std::optional<LabelledImage> labelled(const cv::Mat& image, const Eigen::Isometry3d& T_camera_window,
                                      const geometry::PinholeCamera& camera,
                                      const geometry::OpeningSize& opening);

/// Random split by groups: (the rest, the part `held_out` of the groups, at least one).
/// \throws std::invalid_argument if there are fewer than two groups
std::pair<std::vector<LabelledImage>, std::vector<LabelledImage>> split(
    const std::vector<LabelledImage>& samples, double held_out, std::uint32_t seed);

}  // namespace window_ingress::evaluation
