#include "evaluation/flights/flight_picture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "window_ingress/detection/debug_image.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

using simulation::Outcome;

constexpr int kWidth_px = 960, kMargin_px = 50, kTileWidth_px = 320;
const cv::Scalar kWhite(255, 255, 255), kBlack(0, 0, 0), kGrey(150, 150, 150), kFaint(225, 225, 225);

struct Paint {
  Outcome outcome;
  cv::Scalar colour;  // BGR
};
const Paint kPaints[] = {{Outcome::kPassed, {60, 160, 40}},
                         {Outcome::kAborted, {0, 140, 255}},
                         {Outcome::kTimeout, {150, 150, 150}},
                         {Outcome::kFalseIngress, {200, 0, 200}},
                         {Outcome::kCollision, {30, 30, 220}}};

cv::Scalar colourOf(Outcome outcome) {
  for (const Paint& paint : kPaints)
    if (paint.outcome == outcome) return paint.colour;
  return kBlack;
}

void write(cv::Mat& image, const std::string& text, cv::Point at, double size = 0.45) {
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, size, kBlack, 1, cv::LINE_AA);
}

// One plane of the window's frame, drawn on a part of the image with x to the right.
class Plane {
 public:
  // `axis`: 1 for y (left is up), 2 for z
  Plane(cv::Mat& image, const cv::Rect& part, const Eigen::AlignedBox3d& span, int axis, double scale_px)
      : image_(image), part_(part), span_(span), axis_(axis), scale_px_(scale_px) {}

  void drawGrid() {
    for (int x = static_cast<int>(std::ceil(span_.min().x())); x <= span_.max().x(); ++x) {
      cv::line(image_, at({double(x), span_.min()[axis_]}), at({double(x), span_.max()[axis_]}), kFaint);
      write(image_, std::to_string(x) + " m", at({double(x), span_.min()[axis_]}) + cv::Point(-10, 16), 0.4);
    }
    for (int v = static_cast<int>(std::ceil(span_.min()[axis_])); v <= span_.max()[axis_]; ++v)
      cv::line(image_, at({span_.min().x(), double(v)}), at({span_.max().x(), double(v)}), kFaint);
  }

  void drawWall(double half_gap_m, double thickness_m) {
    const double low = span_.min()[axis_], high = span_.max()[axis_];
    cv::rectangle(image_, at({0.0, low}), at({thickness_m, -half_gap_m}), kGrey, cv::FILLED);
    cv::rectangle(image_, at({0.0, half_gap_m}), at({thickness_m, high}), kGrey, cv::FILLED);
  }

  void draw(const FlightResult& flight) {
    std::vector<cv::Point> line;
    for (const TrackPoint& point : flight.track)
      line.push_back(at({point.position_m.x(), point.position_m[axis_]}));
    if (line.empty()) return;
    cv::polylines(image_, line, false, colourOf(flight.outcome), 1, cv::LINE_AA);
    cv::circle(image_, line.back(), 4, colourOf(flight.outcome), cv::FILLED, cv::LINE_AA);
  }

 private:
  cv::Point at(const Eigen::Vector2d& p) const {
    return {part_.x + cvRound((p.x() - span_.min().x()) * scale_px_),
            part_.y + part_.height - cvRound((p.y() - span_.min()[axis_]) * scale_px_)};
  }

  cv::Mat& image_;
  cv::Rect part_;
  Eigen::AlignedBox3d span_;
  int axis_;
  double scale_px_;
};

Eigen::AlignedBox3d spanOf(const std::vector<FlightResult>& flights, const WallOutline& wall) {
  const Eigen::Vector3d half(0.0, 0.5 * wall.opening_width_m, 0.5 * wall.opening_height_m);
  Eigen::AlignedBox3d span(-half, half + Eigen::Vector3d(wall.thickness_m, 0, 0));
  for (const auto& flight : flights)
    for (const TrackPoint& point : flight.track) span.extend(point.position_m);
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(0.4);
  return {Eigen::Vector3d(span.min() - around), Eigen::Vector3d(span.max() + around)};
}

void drawLegend(cv::Mat& image, const std::vector<FlightResult>& flights, const std::string& title) {
  write(image, title, {kMargin_px, 22}, 0.55);
  int x = kMargin_px;
  for (const Paint& paint : kPaints) {
    const auto count = std::count_if(flights.begin(), flights.end(), [&](const FlightResult& flight) {
      return flight.outcome == paint.outcome;
    });
    if (count == 0) continue;
    cv::circle(image, {x + 5, 38}, 5, paint.colour, cv::FILLED, cv::LINE_AA);
    const std::string text = std::to_string(count) + " " + toString(paint.outcome);
    write(image, text, {x + 16, 43});
    x += 40 + 9 * static_cast<int>(text.size());
  }
}

std::string captionOf(const FlightRecord& record) {
  return formatted("%.2f s %s x %.2f y %+.2f", record.time_sec, toString(record.state), record.position_m.x(),
                   record.position_m.y());
}

}  // namespace

cv::Mat drawTracks(const std::vector<FlightResult>& flights, const WallOutline& wall,
                   const std::string& title) {
  const Eigen::AlignedBox3d span = spanOf(flights, wall);
  const Eigen::Vector3d size_m = span.sizes();
  const double scale_px = (kWidth_px - 2 * kMargin_px) / size_m.x();
  const cv::Rect top(kMargin_px, 60, kWidth_px - 2 * kMargin_px, cvRound(size_m.y() * scale_px));
  const cv::Rect side(kMargin_px, top.br().y + 40, top.width, cvRound(size_m.z() * scale_px));
  cv::Mat image(side.br().y + 30, kWidth_px, CV_8UC3, kWhite);
  Plane above(image, top, span, 1, scale_px), beside(image, side, span, 2, scale_px);
  above.drawGrid();
  beside.drawGrid();
  above.drawWall(0.5 * wall.opening_width_m, wall.thickness_m);
  beside.drawWall(0.5 * wall.opening_height_m, wall.thickness_m);
  for (const FlightResult& flight : flights) {
    above.draw(flight);
    beside.draw(flight);
  }
  drawLegend(image, flights, title);
  write(image, "from above", {top.x + 4, top.y + 14});
  write(image, "from the side", {side.x + 4, side.y + 14});
  return image;
}

void FlightStrip::onImage(const simulation::CameraFrame& frame, const detection::DetectionTrace& trace,
                          const std::optional<detection::WindowObservation>& window) {
  detection::drawDetection(frame.image, trace, window ? &*window : nullptr, canvas_);
}

void FlightStrip::onStep(const FlightRecord& record, const navigation::NavigatorOutput&) {
  if (canvas_.empty()) return;
  last_.caption = captionOf(record);
  canvas_.copyTo(last_.image);
  if (shown_ == record.state || pictures_.size() == kMax) return;
  shown_ = record.state;
  pictures_.push_back({canvas_.clone(), last_.caption});
}

cv::Mat FlightStrip::draw(const FlightResult& flight, const WallOutline& wall) const {
  if (last_.image.empty()) return {};
  const std::string title = "seed " + std::to_string(flight.seed) + ": " + flight.reason;
  std::vector<cv::Mat> rows{drawTracks({flight}, wall, title)};
  std::vector<Picture> all = pictures_;
  all.push_back(last_);
  const int tile_height_px = kTileWidth_px * last_.image.rows / last_.image.cols + 20;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % 3 == 0) rows.emplace_back(tile_height_px, kWidth_px, CV_8UC3, kWhite);
    cv::Mat tile =
        rows.back()(cv::Rect(static_cast<int>(i % 3) * kTileWidth_px, 0, kTileWidth_px, tile_height_px));
    cv::Mat picture = tile.rowRange(20, tile_height_px);
    cv::resize(all[i].image, picture, picture.size(), 0, 0, cv::INTER_AREA);
    write(tile, all[i].caption, {4, 14}, 0.4);
  }
  cv::Mat sheet;
  cv::vconcat(rows, sheet);
  return sheet;
}

}  // namespace window_ingress::evaluation
