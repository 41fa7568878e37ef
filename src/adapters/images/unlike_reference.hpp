#pragma once

#include <string>

#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

/// Images in which the reference alone refuses what looks like a window: another window, or a camera whose
/// colours or orientation are not those of the reference.
class UnlikeReference {
 public:
  static constexpr int kMany = 100;  ///< a decoy that a turn passes by shows in fewer

  /// \param has_window whether a window was found in this image
  void see(const detection::DetectionTrace& trace, bool has_window) {
    using detection::RejectReason;
    if (has_window)
      images_ = 0;
    else if (trace.outcome == RejectReason::kAppearance || trace.outcome == RejectReason::kUnlike)
      ++images_;
  }

  /// \param detail what the last image without a window lacks
  Health health(const std::string& detail) const {
    if (images_ < kMany) return {Health::kOk, "no window: " + detail};
    return {Health::kOk,  // it may be that other windows alone are in view
            formatted("%d images show a window, but none is the reference's: ", images_) + detail};
  }

 private:
  int images_ = 0;
};

}  // namespace window_ingress::adapters
