#include <cmath>
#include <opencv2/imgproc.hpp>

#include "adapters/images/image_conversion.hpp"
#include "any_image.hpp"
#include "targets.hpp"
#include "window_ingress/detection/window_tracker.hpp"

namespace window_ingress::fuzz {
namespace {

// Rectangles in the image: without them hardly any input passes the edge stage.
void drawWindows(Bytes& bytes, cv::Mat& image) {
  for (int i = bytes.take<std::uint8_t>() % 6; i > 0; --i) {
    std::array<cv::Point, 4> quad;
    for (cv::Point& corner : quad) corner = cv::Point(bytes.take<std::int8_t>(), bytes.take<std::int8_t>());
    const cv::Scalar colour(bytes.take<std::uint8_t>(), bytes.take<std::uint8_t>(),
                            bytes.take<std::uint8_t>());
    const bool upright = bytes.take<std::uint8_t>() % 4 > 0;
    if (upright)
      cv::rectangle(image, quad[0], quad[1], colour, cv::FILLED);
    else
      cv::fillConvexPoly(image, quad.data(), 4, colour);
  }
}

void check(const std::optional<detection::WindowObservation>& window,
           const detection::WindowTracker& tracker) {
  if (!window) return require(!tracker.trace().detail.empty(), "no window without a reason");
  require(std::isfinite(window->score), "a finite score");
  for (int i = 0; i < 4; ++i) {
    require(window->corners[i].allFinite() && window->corner_covariance[i].allFinite(), "finite corners");
    require(window->edges[i].a.allFinite() && window->edges[i].b.allFinite(), "finite borders");
  }
}

geometry::PinholeCamera anyCamera(Bytes& bytes, const cv::Mat& image) {
  geometry::PinholeCamera camera = geometry::PinholeCamera::fromFieldOfView(
      image.cols, image.rows, 0.4 + 0.01 * bytes.take<std::uint8_t>());
  for (double& d : camera.distortion) d = 0.002 * bytes.take<std::int8_t>();
  return camera;
}

}  // namespace

void detection(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  static detection::WindowTracker tracker{detection::DetectorParams()};
  tracker.reset();
  const bool calibrated = bytes.take<std::uint8_t>() % 2 > 0;
  const int images = 1 + bytes.take<std::uint8_t>() % 3;
  Bytes scene = bytes;  // equal for all images except for the drawing
  for (int i = 0; i < images; ++i) {
    Bytes drawing = bytes;
    const adapters::DecodedImage guarded = adapters::decode(smallImage(scene), {});
    scene = bytes;
    if (guarded.image.empty()) return;
    cv::Mat image = guarded.image.clone();
    drawWindows(drawing, image);
    const geometry::PinholeCamera camera = anyCamera(drawing, image);
    detection::TrackInput input;
    input.image = image;
    input.stamp_sec = 100.0 + 0.033 * i;
    input.camera = calibrated && camera.validate().empty() ? &camera : nullptr;
    check(tracker.update(input), tracker);
  }
}

}  // namespace window_ingress::fuzz
