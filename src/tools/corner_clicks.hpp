/// A window in which the four inner corners of an opening are clicked.
#pragma once

#include <algorithm>
#include <iostream>
#include <opencv2/highgui.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "corner_fit.hpp"

namespace window_ingress::tools {

inline std::vector<double> flat(const std::vector<cv::Point2d>& points) {
  std::vector<double> numbers;
  for (const auto& point : points) numbers.insert(numbers.end(), {point.x, point.y});
  return numbers;
}

class CornerClicks {
 public:
  explicit CornerClicks(const cv::Mat& image)
      : image_(image), scale_(std::min(1.0, kMaxShownPx / std::max(image.cols, image.rows))) {
    cv::namedWindow(kWindow, cv::WINDOW_AUTOSIZE | cv::WINDOW_GUI_NORMAL);
    cv::setMouseCallback(kWindow, onMouse, this);
  }

  /// \return eight numbers, or nothing if the user gave up
  std::optional<std::vector<double>> run() {
    for (;;) {
      draw();
      const int key = cv::waitKey(30) & 0xff;
      cv::setWindowTitle(kWindow, kNext[points_.size()]);  // what is asked for is on the screen by now
      if (key == 'q' || key == 27) return std::nullopt;
      if (key == 'u' && !points_.empty()) points_.pop_back(), said_.clear();
      if (points_.size() < 4) continue;
      if (key == 'f') fit();
      if ((key == '\r' || key == '\n') && !isDoubtful()) return flat(points_);
    }
  }

 private:
  static void onMouse(int event, int x, int y, int, void* self) {
    static_cast<CornerClicks*>(self)->mouse(event, x, y);
  }

  void mouse(int event, int x, int y) {
    at_ = {std::min((x + 0.5) / scale_ - 0.5, image_.cols - 1.0),
           std::min((y + 0.5) / scale_ - 0.5, image_.rows - 1.0)};
    if (event == cv::EVENT_LBUTTONDOWN) said_.clear();
    if (event == cv::EVENT_LBUTTONUP) dragged_ = -1;
    if (event == cv::EVENT_MOUSEMOVE && dragged_ >= 0) points_[static_cast<std::size_t>(dragged_)] = at_;
    const bool beside = x >= image_.cols * scale_ || y >= image_.rows * scale_;
    if (event != cv::EVENT_LBUTTONDOWN || beside) return;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (cv::norm(points_[i] - at_) * scale_ < 12.0) dragged_ = static_cast<int>(i);
    if (dragged_ >= 0 || points_.size() == 4) return;
    points_.push_back(at_);
    dragged_ = static_cast<int>(points_.size()) - 1;
  }

  // The second Enter saves all the same.
  bool isDoubtful() {
    const CornerFit beside = besideEdges(image_, flat(points_));
    const std::string asked = beside.said + ". Enter saves all the same";
    if (!beside.corners.empty() || said_ == asked) return false;
    said_ = asked;
    return true;
  }

  void fit() {
    const CornerFit fit = fitted(image_, flat(points_));
    said_ = (fit.corners.empty() ? "not fitted: " : "moved by the fit: ") + fit.said;
    std::cout << said_ << std::endl;
    for (std::size_t i = 0; i < points_.size() && !fit.corners.empty(); ++i)
      points_[i] = {fit.corners[2 * i], fit.corners[2 * i + 1]};
  }

  cv::Point onScreen(const cv::Point2d& point) const {
    return {cvRound((point.x + 0.5) * scale_ - 0.5), cvRound((point.y + 0.5) * scale_ - 0.5)};
  }

  void draw() const {
    cv::Mat shown;
    cv::resize(image_, shown, cv::Size(), scale_, scale_, scale_ < 1.0 ? cv::INTER_AREA : cv::INTER_NEAREST);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (i > 0 || points_.size() == 4)
        cv::line(shown, onScreen(points_[i]), onScreen(points_[(i + points_.size() - 1) % points_.size()]),
                 kBorder, 1, cv::LINE_AA);
      cv::circle(shown, onScreen(points_[i]), 5, kCorner, 1, cv::LINE_AA);
    }
    cv::Mat canvas(std::max(shown.rows, kPanelHeight), shown.cols + kPanelWidth, CV_8UC3,
                   cv::Scalar::all(24));
    shown.copyTo(canvas(cv::Rect({0, 0}, shown.size())));
    drawPanel(canvas(cv::Rect(shown.cols, 0, kPanelWidth, canvas.rows)));
    cv::imshow(kWindow, canvas);
  }

  // Beside the image, so that no corner is ever covered: what is under the mouse, and what everything means.
  void drawPanel(cv::Mat panel) const {
    cv::Mat part, lens;
    cv::getRectSubPix(image_, cv::Size(kLens, kLens),
                      cv::Point2f(static_cast<float>(at_.x), static_cast<float>(at_.y)), part);
    cv::resize(part, lens, cv::Size(), kZoom, kZoom, cv::INTER_NEAREST);
    cv::drawMarker(lens, cv::Point(lens.cols / 2, lens.rows / 2), cv::Scalar(0, 0, 255), cv::MARKER_CROSS,
                   lens.cols, 1);
    lens.copyTo(panel(cv::Rect({kMargin, kMargin}, lens.size())));
    int y = lens.rows + 2 * kMargin + 10;
    const auto write = [&](const std::string& text, const cv::Scalar& colour) {
      for (const std::string& line : wrapped(text)) {
        cv::putText(panel, line, {kMargin, y}, cv::FONT_HERSHEY_SIMPLEX, 0.42, colour, 1, cv::LINE_AA);
        y += kLine;
      }
    };
    write("above: under the mouse, enlarged", kText);
    write("green: inner border of the opening", kBorder);
    write("yellow: its corners; drag to correct", kCorner);
    y += kLine / 2;
    for (const char* key : {"f: fit the corners to the edges", "u: take the last corner back", "Enter: save",
                            "q: quit, nothing is written"})
      write(key, kText);
    y += kLine / 2;
    write(said_.empty() ? kNext[points_.size()] : said_, cv::Scalar(60, 220, 255));
  }

  static std::vector<std::string> wrapped(const std::string& text) {
    std::vector<std::string> lines(1);
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      if (lines.back().size() + word.size() > kLetters) lines.emplace_back();
      lines.back() += (lines.back().empty() ? "" : " ") + word;
    }
    return lines;
  }

  static constexpr const char* kWindow = "make_reference";
  // What the title asks for, by the number of corners there are.
  static constexpr const char* kNext[] = {
      "click the top left inner corner of the opening", "click the top right inner corner",
      "click the bottom right inner corner", "click the bottom left inner corner",
      "four corners: Enter saves, f fits them to the edges, u takes the last one back"};
  static constexpr int kLens = 45, kZoom = 4, kMargin = 10, kLine = 18;  // [px]
  static constexpr int kPanelWidth = 300, kPanelHeight = 440;            // [px]
  static constexpr std::size_t kLetters = 38;
  const cv::Scalar kBorder{60, 230, 60}, kCorner{0, 255, 255}, kText{220, 220, 220};

  cv::Mat image_;
  double scale_;
  std::vector<cv::Point2d> points_;
  cv::Point2d at_{0.0, 0.0};
  int dragged_ = -1;
  std::string said_;  // of the last fit
};

}  // namespace window_ingress::tools
