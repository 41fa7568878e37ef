#include "evaluation/flights/flight_picture.hpp"

#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "window_ingress/detection/debug_image.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

using simulation::Outcome;

constexpr int kWidth_px = 960, kMargin_px = 50, kTileWidth_px = 320;
const cv::Scalar kWhite(255, 255, 255), kBlack(0, 0, 0), kGrey(150, 150, 150), kFaint(225, 225, 225);

// In the order of the legend, BGR.
const std::pair<Outcome, cv::Scalar> kColours[] = {{Outcome::kPassed, {60, 160, 40}},
                                                   {Outcome::kAborted, {0, 140, 255}},
                                                   {Outcome::kTimeout, {150, 150, 150}},
                                                   {Outcome::kFalseIngress, {200, 0, 200}},
                                                   {Outcome::kCollision, {30, 30, 220}}};

cv::Scalar colourOf(Outcome wanted) {
  for (const auto& [outcome, colour] : kColours)
    if (outcome == wanted) return colour;
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

  // Grid, wall and flights.
  void draw(double half_gap_m, double thickness_m, const std::vector<FlightResult>& flights) {
    const double low = span_.min()[axis_], high = span_.max()[axis_];
    for (int x = static_cast<int>(std::ceil(span_.min().x())); x <= span_.max().x(); ++x) {
      cv::line(image_, at(x, low), at(x, high), kFaint);
      write(image_, std::to_string(x) + " m", at(x, low) + cv::Point(-10, 16), 0.4);
    }
    for (int v = static_cast<int>(std::ceil(low)); v <= high; ++v)
      cv::line(image_, at(span_.min().x(), v), at(span_.max().x(), v), kFaint);
    cv::rectangle(image_, at(0.0, low), at(thickness_m, -half_gap_m), kGrey, cv::FILLED);
    cv::rectangle(image_, at(0.0, half_gap_m), at(thickness_m, high), kGrey, cv::FILLED);
    for (const FlightResult& flight : flights) {
      std::vector<cv::Point> line;
      for (const auto& [time_sec, p] : flight.track) line.push_back(at(p.x(), p[axis_]));
      if (line.empty()) continue;
      cv::polylines(image_, line, false, colourOf(flight.outcome), 1, cv::LINE_AA);
      cv::circle(image_, line.back(), 4, colourOf(flight.outcome), cv::FILLED, cv::LINE_AA);
    }
  }

 private:
  cv::Point at(double x, double y_or_z) const {
    return {part_.x + cvRound((x - span_.min().x()) * scale_px_),
            part_.y + part_.height - cvRound((y_or_z - span_.min()[axis_]) * scale_px_)};
  }

  cv::Mat& image_;
  cv::Rect part_;
  Eigen::AlignedBox3d span_;
  int axis_;
  double scale_px_;
};

void drawLegend(cv::Mat& image, const std::vector<FlightResult>& flights, const std::string& title) {
  write(image, title, {kMargin_px, 22}, 0.55);
  int x = kMargin_px;
  std::map<Outcome, int> counts;
  for (const FlightResult& flight : flights) ++counts[flight.outcome];
  for (const auto& [outcome, colour] : kColours) {
    if (counts[outcome] == 0) continue;
    cv::circle(image, {x + 5, 38}, 5, colour, cv::FILLED, cv::LINE_AA);
    const std::string text = std::to_string(counts[outcome]) + " " + toString(outcome);
    write(image, text, {x + 16, 43});
    x += 40 + 9 * static_cast<int>(text.size());
  }
}

}  // namespace

cv::Mat drawTracks(const std::vector<FlightResult>& flights, const simulation::Scenario& scenario,
                   const std::string& title) {
  const double thickness_m = scenario.window.frame_depth_m + scenario.house.wall_thickness_m;
  const Eigen::Vector3d half(0.0, 0.5 * scenario.window.width_m, 0.5 * scenario.window.height_m);
  Eigen::AlignedBox3d span(-half, half + Eigen::Vector3d(thickness_m, 0, 0));
  for (const auto& flight : flights)
    for (const TrackPoint& point : flight.track) span.extend(point.position_m);
  span.min().array() -= 0.4;
  span.max().array() += 0.4;
  const Eigen::Vector3d size_m = span.sizes();
  const double scale_px = (kWidth_px - 2 * kMargin_px) / size_m.x();
  const cv::Rect top(kMargin_px, 60, kWidth_px - 2 * kMargin_px, cvRound(size_m.y() * scale_px));
  const cv::Rect side(kMargin_px, top.br().y + 40, top.width, cvRound(size_m.z() * scale_px));
  cv::Mat image(side.br().y + 30, kWidth_px, CV_8UC3, kWhite);
  Plane above(image, top, span, 1, scale_px), beside(image, side, span, 2, scale_px);
  above.draw(half.y(), thickness_m, flights);
  beside.draw(half.z(), thickness_m, flights);
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
  last_.caption = formatted("%.2f s %s x %.2f y %+.2f", record.time_sec, toString(record.state),
                            record.position_m.x(), record.position_m.y());
  canvas_.copyTo(last_.image);
  if (shown_ == record.state || pictures_.size() == kMax) return;
  shown_ = record.state;
  pictures_.push_back({canvas_.clone(), last_.caption});
}

cv::Mat FlightStrip::draw(const FlightResult& flight, const simulation::Scenario& scenario) const {
  if (last_.image.empty()) return {};
  const std::string title = "seed " + std::to_string(flight.seed) + ": " + flight.reason;
  std::vector<cv::Mat> rows{drawTracks({flight}, scenario, title)};
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
