#include "adapters/bags/detection_strip.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "adapters/bags/replay_tables.hpp"
#include "evaluation/csv.hpp"
#include "window_ingress/detection/debug_image.hpp"
#include "window_ingress/geometry/yaw_text.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

constexpr int kWidestPx = 640, kQuality = 80;

std::string named(std::size_t number) { return formatted("pictures/%05zu.jpg", number); }

std::string captionOf(const ReplayedFrame& frame) {
  if (!frame.row.window) return "no window: " + frame.row.reject_reason;
  if (!frame.row.pose) return "window";
  return geometry::yawText(frame.row.pose->yaw_rad, frame.row.pose->yaw_sigma_rad,
                           frame.row.pose->sign_trusted);
}

}  // namespace

DetectionStrip::DetectionStrip(const std::filesystem::path& folder, std::size_t images)
    : folder_(folder), step_(std::max<std::size_t>(1, (images + kMax - 1) / kMax)) {
  std::filesystem::remove_all(folder / "pictures");
  std::filesystem::create_directories(folder / "pictures");
  list_.open(folder / "strip.csv");
  list_ << "stamp,file,shown,caption\n";
}

const char* DetectionStrip::whyShown(const ReplayedFrame& frame) {
  const bool is_found = frame.row.window.has_value(), is_first = seen_ == 0;
  const bool changed = !is_first && is_found != was_found_;
  was_found_ = is_found;
  const bool is_due = seen_++ % step_ == 0;
  if (changed && changes_++ < kMaxChanges) return is_found ? "found" : "lost";
  return is_due ? "time" : nullptr;
}

void DetectionStrip::add(const ReplayedFrame& frame) {
  const char* why = whyShown(frame);
  if (!why || frame.image.empty() || !frame.perception) return;
  detection::drawDetection(frame.image, frame.perception->trace(),
                           frame.row.window ? &*frame.row.window : nullptr, canvas_);
  const double scale = std::min(1.0, static_cast<double>(kWidestPx) / canvas_.cols);
  cv::Mat small;
  cv::resize(canvas_, small, {}, scale, scale, cv::INTER_AREA);
  const std::string file = named(seen_);
  evaluation::writeImage(folder_ / file, small, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  list_ << exactText(frame.stamp) << "," << file << "," << why << ","
        << evaluation::csvField(captionOf(frame)) << "\n";
  list_.finish();
}

}  // namespace window_ingress::adapters
