#include "adapters/bags/waiting_images.hpp"

#include <utility>

namespace window_ingress::adapters {
namespace {

constexpr std::size_t kMaxWaiting = 30;
constexpr double kAttitudeWaitSec = 0.05;  // in time of the bag

}  // namespace

std::optional<WaitingImages::Image> WaitingImages::take() {
  if (images_.empty()) return std::nullopt;
  std::optional<Image> first = std::move(images_.front());
  images_.pop_front();
  return first;
}

std::optional<WaitingImages::Image> WaitingImages::takeComplete(double newest_sec) {
  const bool too_many = images_.size() > kMaxWaiting;
  if (!too_many && (images_.empty() || !isComplete(images_.front(), newest_sec))) return std::nullopt;
  return take();
}

bool WaitingImages::isComplete(const Image& image, double newest_sec) const {
  const double sec = image.header.stamp.toSec();
  const bool awaits_attitude = for_attitude_ && newest_sec < sec + kAttitudeWaitSec;
  return !(for_odometry_ && odometry_sec_ < sec) && !(awaits_attitude && attitude_sec_ < sec);
}

void WaitingImages::clear() {
  images_.clear();
  odometry_sec_ = attitude_sec_ = -1.0;
}

}  // namespace window_ingress::adapters
