#pragma once

#include <string>
#include <vector>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/openness/interior_klt_params.hpp"

namespace window_ingress::configuration {

/// Limits of input images.
struct ImageLimits {
  int max_pixels = 8000000;  ///< images with more pixels are refused [px]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_pixels", self.max_pixels, 1, 100000000);
  }
};

/// The reference image.
struct ReferenceParams {
  std::string picture;          ///< JPEG or PNG file of the target; empty: no reference
  std::vector<double> corners;  ///< corners of the opening's inner border in the reference image, clockwise
                                ///< from the top left: x1 y1 .. x4 y4 [px]; empty: the whole image shows the
                                ///< target with its frame
  std::string capture_file;     ///< JPEG or PNG file written by ~capture_reference, numbered if it exists;
                                ///< beside it, .yaml holds its parameters and _understood.png shows how it is
                                ///< interpreted; empty: nothing is written
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("picture", self.picture);
    field("corners", self.corners);
    field("capture_file", self.capture_file);
  }
};

struct DetectorNodeParams {
  std::string image_transport = "raw";  ///< raw, compressed, or a plugin of image_transport
  bool use_imu = true;     ///< predict tracks with the vehicle's attitude from `imu`, if messages arrive
  double budget_ms = 0.0;  ///< diagnostics warn if an image takes longer; 0: the time between two images [ms]
  double max_rate_hz = 0.0;  ///< images used a second at most; 0: all; not in lockstep or replays [1/s]
  bool lockstep = false;     ///< run step by step with the simulated world; only with use_sim_time
  ImageLimits image;
  ReferenceParams reference;
  detection::DetectorParams detector;
  openness::InteriorKltParams interior;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("image_transport", self.image_transport);
    field("use_imu", self.use_imu);
    field("budget_ms", self.budget_ms, 0.0, 10000.0);
    field("max_rate_hz", self.max_rate_hz, 0.0, 1000.0);
    field("lockstep", self.lockstep);
    field.group("image", self.image);
    field.group("reference", self.reference);
    field.group("detector", self.detector);
    field.group("interior", self.interior);
  }
};

}  // namespace window_ingress::configuration
