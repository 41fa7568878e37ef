#pragma once

#include <string>
#include <vector>

#include "window_ingress/configuration/common_params.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/openness/interior_klt_params.hpp"

namespace window_ingress::configuration {

/// The operator's image of the target.
struct ReferenceParams {
  std::string picture;          ///< file; empty: no reference
  std::vector<double> corners;  ///< of the opening's inner border in it, x1 y1 .. x4 y4 from top left,
                                ///< clockwise [px]; empty: the whole image is the target with its frame
  std::string capture_file;     ///< image that ~capture_reference writes; beside it .yaml, these parameters
                             ///< for it, and _understood.png, what is made of it; empty: nothing is written
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("picture", self.picture);
    field("corners", self.corners);
    field("capture_file", self.capture_file);
  }
};

struct DetectorNodeParams {
  std::string image_transport = "raw";   ///< raw, compressed, or a plugin of image_transport
  bool image_is_rectified = false;       ///< images are rectified: P of camera_info counts
  bool use_imu = true;                   ///< tracks are led by the attitude on `imu`, where there is one
  std::string base_frame = "base_link";  ///< the vehicle's, in which `imu` must be
  double budget_ms = 0.0;  ///< diagnostics warn if an image takes longer; 0: the time between two images [ms]
  bool lockstep = false;   ///< with the simulated world, step by step; only with use_sim_time
  ImageLimits image;
  StampLimits stamps;
  ReferenceParams reference;
  detection::DetectorParams detector;
  openness::InteriorKltParams interior;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("image_transport", self.image_transport);
    field("image_is_rectified", self.image_is_rectified);
    field("use_imu", self.use_imu);
    field("base_frame", self.base_frame);
    field("budget_ms", self.budget_ms, 0.0, 10000.0);
    field("lockstep", self.lockstep);
    field.group("image", self.image);
    field.group("stamps", self.stamps);
    field.group("reference", self.reference);
    field.group("detector", self.detector);
    field.group("interior", self.interior);
  }
};

}  // namespace window_ingress::configuration
