/// Makes the operator's reference from an image of the target: four corners, clicked or given. See --help.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <opencv2/highgui.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "adapters/images/reference_source.hpp"
#include "adapters/markers/marker_sketch.hpp"
#include "command_line.hpp"
#include "display.hpp"
#include "evaluation/output_file.hpp"
#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/detection/border_refinement.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"
#include "window_ingress/text/text.hpp"

namespace {

namespace fs = std::filesystem;
using namespace window_ingress;

constexpr double kMaxShownPx = 1000.0;  // of the image on the screen, 300 more for the panel
constexpr double kFitRadiusPx = 6.0;    // on the screen
constexpr double kMaxMovedPx = 3.0;     // of a side by the fit, on the screen: clicks are more accurate
constexpr double kMaxMovedPart = 0.04;  // the same as part of the shortest side
constexpr double kNearPx = 3.0;         // on the screen: corners further from an edge are doubtful
constexpr double kMinOnEdge = 0.7;      // of each side, on one straight edge
const char* const kSides[] = {"top", "right", "bottom", "left"};

/// Result of a fit of the corners to the edges near them.
struct CornerFit {
  std::vector<double> corners;  ///< empty: the fit failed
  std::string said;             ///< how far each side moves, or why the fit is refused
};

// How far the ends of the side that begins at this corner have moved [px].
double sideMovedPx(const geometry::Quadrilateral& from, const geometry::Quadrilateral& to, std::size_t side) {
  const Eigen::Vector2d begin = to[side], along = (to[(side + 1) % 4] - begin).normalized();
  const auto across = [&](const Eigen::Vector2d& p) { return std::abs(geometry::cross(along, p - begin)); };
  return std::max(across(from[side]), across(from[(side + 1) % 4]));
}

/// Fits to the strongest edges within `radius_px` on the screen. Refused if a side finds no edge, or one too
/// far away for a click.
CornerFit fittedWithin(double radius_px, const cv::Mat& image, const std::vector<double>& corners) {
  geometry::Quadrilateral quad;
  for (std::size_t i = 0; i < 4; ++i) quad[i] = {corners[2 * i], corners[2 * i + 1]};
  const auto clicked = geometry::canonical(quad);
  if (!clicked) return {{}, "the corners are not a convex quadrilateral"};
  const double scale = std::max(1.0, std::max(image.cols, image.rows) / kMaxShownPx);
  double on_edge = 0.0;
  const auto borders = detection::refineBorders(image, {*clicked, radius_px * scale}, nullptr, &on_edge);
  if (on_edge < kMinOnEdge)
    return {{}, formatted("only %.0f %% of one side lie on a straight edge near it", 100.0 * on_edge)};
  if (!borders) return {{}, "the straight edge near one side leads away from its corners"};
  const auto sides_px = geometry::sideLengths(*clicked);
  const double most_px =
      std::min(kMaxMovedPx * scale, kMaxMovedPart * *std::min_element(sides_px.begin(), sides_px.end()));
  CornerFit fit;
  for (std::size_t side = 0; side < 4; ++side) {
    const double moved_px = sideMovedPx(*clicked, borders->corners, side);
    if (!(moved_px <= most_px))
      return {{},
              formatted("the %s side would move by %.1f px, more than %.1f, so it lies beside the inner edge",
                        kSides[side], moved_px, most_px)};
    fit.said += formatted("%s%s %.1f px", side == 0 ? "" : ", ", kSides[side], moved_px);
  }
  for (const auto& corner : borders->corners) fit.corners.insert(fit.corners.end(), {corner.x(), corner.y()});
  return fit;
}

/// A deep frame has two parallel edges, and the further one may be the stronger: near edges are tried first.
CornerFit fitted(const cv::Mat& image, const std::vector<double>& corners) {
  const CornerFit near = fittedWithin(kNearPx, image, corners);
  return near.corners.empty() ? fittedWithin(kFitRadiusPx, image, corners) : near;
}

/// Distance of unfitted corners from the edges near them; no edges are near poor corners.
CornerFit besideEdges(const cv::Mat& image, const std::vector<double>& corners) {
  CornerFit fit = fittedWithin(kNearPx, image, corners);
  fit.said = (fit.corners.empty() ? "poor corners: " : "beside the edges near them: ") + fit.said;
  return fit;
}

std::vector<double> flat(const std::vector<cv::Point2d>& points) {
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

  /// \return eight numbers, or nothing if the user cancelled
  std::optional<std::vector<double>> run() {
    for (;;) {
      draw();
      const int key = cv::waitKey(30) & 0xff;
      cv::setWindowTitle(kWindow, kNext[points_.size()]);  // by now the window is on the screen
      if (key == 'q' || key == 27) return std::nullopt;
      if (key == 'u' && !points_.empty()) points_.pop_back(), said_.clear(), dragged_ = -1;
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

  // A second Enter saves anyway.
  bool isDoubtful() {
    const CornerFit beside = besideEdges(image_, flat(points_));
    const std::string asked = beside.said + ". Enter saves anyway";
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

  // Beside the image, so that no corner is covered: the area under the mouse, and a legend.
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
      std::istringstream lines(adapters::wrapped(text, kLetters));
      for (std::string line; std::getline(lines, line);) {
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

  static constexpr const char* kWindow = "make_reference";
  // Instruction in the title, by the number of corners set.
  static constexpr const char* kNext[] = {
      "click the top left inner corner of the opening", "click the top right inner corner",
      "click the bottom right inner corner", "click the bottom left inner corner",
      "four corners: Enter saves, f fits them to the edges, u takes the last one back"};
  static constexpr int kLens = 45, kZoom = 4, kMargin = 10, kLine = 18;  // [px]
  static constexpr int kPanelWidth = 300, kPanelHeight = 440;            // [px]
  static constexpr std::size_t kLetters = 39;                            // of a line
  const cv::Scalar kBorder{60, 230, 60}, kCorner{0, 255, 255}, kText{220, 220, 220};

  cv::Mat image_;
  double scale_;
  std::vector<cv::Point2d> points_;
  cv::Point2d at_{0.0, 0.0};
  int dragged_ = -1;
  std::string said_;  // report of the last fit
};

struct Job {
  std::string image, output = "reference.png", corners, params;
  bool fit = false, overwrite = false;
};

tools::OptionList describe(Job& job) {
  tools::OptionList add(
      "Usage: make_reference IMAGE [OPTION...]\n"
      "Writes the image, a yaml file of the same name for config:=, and NAME_understood.png, which shows the "
      "inner border and the regions whose colours are compared.\nWithout --corners a window opens: click the "
      "four inner corners of the opening, top left first, then clockwise; drag to correct,\nf: fit them to "
      "the edges, u: undo, Enter: save, q: quit.");
  add("picture", job.image, "photograph of the target with some wall round it");
  add("output", job.output, "image to write");
  add("overwrite", job.overwrite, tools::kOverwriteHelp);
  add("corners", job.corners, "x1,y1,...,x4,y4 instead of clicking; pixel centres are integers");
  add("fit", job.fit, "fit the corners to the edges near them");
  add("params", job.params, tools::kParamsHelp);
  add.unnamed.add("picture", 1);
  return add;
}

int run(const Job& job) {
  if (job.image.empty()) throw InputError("no image given; see --help");
  const adapters::ReferenceFiles files(job.output);
  if (!job.overwrite) tools::checkReplacesNothing({files.image, files.overlay, files.understood});
  const auto params = configuration::readOverlay(job.params).window_detector.detector;
  const cv::Mat image = evaluation::readImage(job.image);
  std::vector<double> corners;
  if (!job.corners.empty()) {
    corners = tools::numbers("--corners", job.corners, 8);
  } else {
    if (!tools::hasDisplay())
      throw InputError("there is no display to click in: give --corners x1,y1,...,x4,y4");
    const auto clicked = CornerClicks(image).run();
    if (!clicked) throw std::runtime_error("cancelled, nothing written");
    corners = *clicked;
  }
  if (job.fit) {
    const auto fit = fitted(image, corners);
    if (fit.corners.empty())
      throw std::runtime_error("not fitted: " + fit.said + "; correct the corners, or leave out --fit");
    std::cout << "moved by the fit: " << fit.said << "\n";
    corners = fit.corners;
  }
  const auto reference = adapters::makeReference(image, corners, params);
  const auto beside = besideEdges(image, corners);
  if (beside.corners.empty())
    std::cerr << "make_reference: warning: " << beside.said << "\n";
  else
    std::cout << beside.said << "\n";
  adapters::saveReference(job.output, reference);
  const char* const called_by = std::getenv("WINDOW_INGRESS_RUN");  // scripts/run as the user called it
  std::cout << "written: " << files.image.string() << "\nlook at: " << files.understood.string()
            << "\nuse it:  " << (called_by ? called_by + std::string(" ") : "")
            << "roslaunch window_ingress px4.launch window_size:=W,H config:=" << files.overlay
            << "; ardupilot.launch and ingress.launch take the same; W,H: inner size of the opening [m]\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return tools::runTool("make_reference", argc, argv, describe, run); }
