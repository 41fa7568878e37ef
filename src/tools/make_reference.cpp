/// Makes the operator's reference from a picture of the target: four corners, clicked or given. See --help.
#include <algorithm>
#include <boost/program_options.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <opencv2/highgui.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "adapters/parameters.hpp"
#include "adapters/reference_source.hpp"
#include "command_line.hpp"
#include "display.hpp"
#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/detection/border_refinement.hpp"

namespace {

namespace fs = std::filesystem;
namespace options = boost::program_options;
using namespace window_ingress;
using tools::UsageError;

constexpr double kMostPx = 1200.0;  // of the picture on the screen
constexpr int kLens = 60, kZoom = 5;
constexpr double kFitRadiusPx = 6.0;  // on the screen
const char* const kWindow = "make_reference";
// What the title asks for, by the number of corners there are.
const char* const kNext[] = {
    "click the top left inner corner of the opening", "click the top right inner corner",
    "click the bottom right inner corner", "click the bottom left inner corner",
    "four corners: Enter saves, f fits them to the edges, u takes the last one back"};

struct Job {
  std::string picture, output = "reference.png", corners, params;
  bool fit = false;
};

options::options_description describe(Job& job) {
  options::options_description description(
      "make_reference PICTURE [OPTION...]\n"
      "Writes the picture, a yaml file of the same name for config:=, and NAME_understood.png, which shows "
      "the inner border "
      "and the regions whose colours are compared.\nWithout --corners a window opens: click the four inner "
      "corners of the "
      "opening, top left first, then clockwise; drag to correct,\nf: fit them to the edges, u: undo, Enter: "
      "save, q: "
      "quit.\n");
  description.add_options()("help", "print this text")                                               //
      ("picture", options::value(&job.picture), "photograph of the target with some wall round it")  //
      ("output", options::value(&job.output)->default_value(job.output), "picture to write")         //
      ("corners", options::value(&job.corners),
       "x1,y1,...,x4,y4 instead of clicking; pixel centres are integers")                //
      ("fit", options::bool_switch(&job.fit), "fit the corners to the edges near them")  //
      ("params", options::value(&job.params), tools::kParamsHelp);
  return description;
}

std::vector<double> flat(const std::vector<cv::Point2d>& points) {
  std::vector<double> numbers;
  for (const auto& point : points) numbers.insert(numbers.end(), {point.x, point.y});
  return numbers;
}

/// The corners where straight edges near them meet; nothing if there are none.
std::optional<std::vector<double>> fitted(const cv::Mat& picture, const std::vector<double>& corners) {
  geometry::Quadrilateral quad;
  for (std::size_t i = 0; i < 4; ++i) quad[i] = {corners[2 * i], corners[2 * i + 1]};
  const auto canonical = geometry::canonical(quad);
  if (!canonical) return std::nullopt;
  const double radius_px = kFitRadiusPx * std::max(1.0, std::max(picture.cols, picture.rows) / kMostPx);
  const auto borders = detection::BorderRefinement().run(picture, {*canonical, radius_px}, nullptr);
  if (!borders) return std::nullopt;
  std::vector<double> result;
  for (const auto& corner : borders->corners) result.insert(result.end(), {corner.x(), corner.y()});
  return result;
}

/// A window in which four corners are clicked.
class Clicking {
 public:
  explicit Clicking(const cv::Mat& picture)
      : picture_(picture),
        scale_(std::min(1.0, kMostPx / std::max(picture.cols, picture.rows))) {
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
      if (key == 'u' && !points_.empty()) points_.pop_back();
      if (points_.size() < 4) continue;
      if (key == 'f') fit();
      if (key == '\r' || key == '\n') return flat(points_);
    }
  }

 private:
  static void onMouse(int event, int x, int y, int, void* self) {
    static_cast<Clicking*>(self)->mouse(event, x, y);
  }

  void mouse(int event, int x, int y) {
    at_ = {(x + 0.5) / scale_ - 0.5, (y + 0.5) / scale_ - 0.5};
    if (event == cv::EVENT_LBUTTONUP) dragged_ = -1;
    if (event == cv::EVENT_MOUSEMOVE && dragged_ >= 0) points_[static_cast<std::size_t>(dragged_)] = at_;
    if (event != cv::EVENT_LBUTTONDOWN) return;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (cv::norm(points_[i] - at_) * scale_ < 12.0) dragged_ = static_cast<int>(i);
    if (dragged_ >= 0 || points_.size() == 4) return;
    points_.push_back(at_);
    dragged_ = static_cast<int>(points_.size()) - 1;
  }

  void fit() {
    const auto corners = fitted(picture_, flat(points_));
    if (!corners) return;
    for (std::size_t i = 0; i < 4; ++i) points_[i] = {(*corners)[2 * i], (*corners)[2 * i + 1]};
  }

  cv::Point onScreen(const cv::Point2d& point) const {
    return {cvRound((point.x + 0.5) * scale_ - 0.5), cvRound((point.y + 0.5) * scale_ - 0.5)};
  }

  void draw() {
    cv::Mat canvas;
    cv::resize(picture_, canvas, cv::Size(), scale_, scale_,
               scale_ < 1.0 ? cv::INTER_AREA : cv::INTER_NEAREST);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (i > 0 || points_.size() == 4)
        cv::line(canvas, onScreen(points_[i]), onScreen(points_[(i + points_.size() - 1) % points_.size()]),
                 cv::Scalar(60, 230, 60), 1, cv::LINE_AA);
      cv::circle(canvas, onScreen(points_[i]), 5, cv::Scalar(0, 255, 255), 1, cv::LINE_AA);
    }
    drawLens(canvas);
    cv::imshow(kWindow, canvas);
  }

  // What is under the mouse, enlarged, in the corner far from it.
  void drawLens(cv::Mat& canvas) const {
    cv::Mat part, lens;
    cv::getRectSubPix(picture_, cv::Size(kLens, kLens),
                      cv::Point2f(static_cast<float>(at_.x), static_cast<float>(at_.y)), part);
    cv::resize(part, lens, cv::Size(), kZoom, kZoom, cv::INTER_NEAREST);
    if (lens.cols >= canvas.cols || lens.rows >= canvas.rows) return;
    const cv::Point middle(lens.cols / 2, lens.rows / 2);
    cv::drawMarker(lens, middle, cv::Scalar(0, 0, 255), cv::MARKER_CROSS, lens.cols, 1);
    const bool left = at_.x > 0.5 * picture_.cols;
    lens.copyTo(canvas(cv::Rect({left ? 0 : canvas.cols - lens.cols, 0}, lens.size())));
  }

  cv::Mat picture_;
  double scale_;
  std::vector<cv::Point2d> points_;
  cv::Point2d at_{0.0, 0.0};
  int dragged_ = -1;
};

int run(const Job& job) {
  if (job.picture.empty()) throw UsageError("no picture given; see --help");
  const auto params = configuration::readOverlay(job.params).window_detector.detector;
  cv::Mat picture;
  if (fs::exists(job.picture))
    picture = cv::imread(job.picture, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (picture.empty()) throw UsageError(job.picture + ": cannot be read as a picture");
  std::vector<double> corners;
  if (!job.corners.empty()) {
    corners = tools::numbers("--corners", job.corners, 8);
  } else {
    if (!tools::hasDisplay())
      throw UsageError("there is no display to click in: give --corners x1,y1,...,x4,y4");
    const auto clicked = Clicking(picture).run();
    if (!clicked) throw std::runtime_error("given up, nothing written");
    corners = *clicked;
  }
  if (job.fit) {
    const auto better = fitted(picture, corners);
    if (!better) throw std::runtime_error("no straight edges near the corners; try without --fit");
    corners = *better;
  }
  adapters::saveReference(job.output, adapters::makeReference(picture, corners, params), params);
  const fs::path written = fs::absolute(job.output);
  std::cout << "written: " << written.string() << "\nlook at: "
            << (written.parent_path() / (written.stem().string() + "_understood.png")).string()
            << "\nuse it:  scripts/run roslaunch window_ingress ingress.launch config:="
            << fs::path(written).replace_extension(".yaml").string() << "\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return tools::runTool("make_reference", argc, argv, describe, run,
                        options::positional_options_description().add("picture", 1));
}
