/// Finds the window in single images; one csv row per image. See --help.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "evaluation/csv.hpp"
#include "evaluation/images/detection_table.hpp"
#include "evaluation/output_file.hpp"
#include "params_file.hpp"
#include "window_ingress/detection/debug_image.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/detection/window_tracker.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/parameters/calibration_file.hpp"

namespace fs = std::filesystem;
using namespace window_ingress;
using tools::numbers;

namespace {

using Clock = std::chrono::steady_clock;

/// Searches the window in each image separately, or tracks it from image to image.
class WindowFinder {
 public:
  /// \param sequence_hz frame rate of an image sequence; 0: images are independent
  WindowFinder(const detection::DetectorParams& params,
               const std::optional<detection::ReferenceAppearance>& reference, double sequence_hz)
      : frame_sec_(sequence_hz > 0.0 ? 1.0 / sequence_hz : 0.0) {
    if (sequence_hz > 0.0)
      tracker_.emplace(params);
    else
      detector_.emplace(params);
    if (reference && tracker_) tracker_->setReference(*reference);
    if (reference && detector_) detector_->setReference(*reference);
  }

  std::optional<detection::WindowObservation> find(const cv::Mat& image,
                                                   const geometry::PinholeCamera* camera) {
    if (detector_) return detector_->detect(image, 0.0, camera);
    detection::TrackInput input;
    input.image = image;
    input.stamp_sec = frame_sec_ * static_cast<double>(++frames_);
    input.camera = camera;
    return tracker_->update(input);
  }

  void skip() { ++frames_; }
  const detection::DetectionTrace& trace() const {
    return detector_ ? detector_->trace() : tracker_->trace();
  }

  std::string columns() const { return tracker_ ? ",target_id,visible_sides" : ""; }
  std::string values(const evaluation::DetectionRow& row) const {
    if (!tracker_) return "";
    if (!row.window) return ",,";
    return "," + std::to_string(row.window->target_id) + "," + std::to_string(row.window->visibleSides());
  }

 private:
  double frame_sec_;
  long frames_ = 0;
  std::optional<detection::WindowDetector> detector_;
  std::optional<detection::WindowTracker> tracker_;
};

struct Options {
  std::vector<std::string> inputs;
  std::string output, camera, reference, corners, size, params, overlay, candidates;
  bool track = false;
  double rate_hz = 30.0;
};

/// Settings common to all images.
struct Job {
  detection::DetectorParams params;
  std::optional<geometry::PinholeCamera> camera;
  std::optional<detection::ReferenceAppearance> reference;
  std::optional<estimation::WindowPoseEstimator> estimator;
};

tools::OptionList describe(Options& o) {
  tools::OptionList add(
      "Usage: detect_images --output OUT.csv [options] FILE_OR_DIR...\n"
      "Finds the window in each image and writes one csv row an image, in the order given.\n"
      "Exit code: 0 done, 1 some image could not be read, 2 wrong usage or unreadable input.");
  add("input", o.inputs, "images, or folders of them; needs no name");
  add.required("output,o", o.output, "csv file to write");
  add("camera", o.camera, "calibration, yaml of camera_info_manager");
  add("reference", o.reference, "image of the target with its frame");
  add("reference-corners", o.corners, "x1,y1,...,x4,y4: inner border of the opening in it");
  add("window-size", o.size, "W,H: inner size of the opening [m]; with --camera: poses");
  add("params", o.params, tools::kParamsHelp);
  add("track", o.track, "the images are a sequence: follow the window through it");
  add("rate", o.rate_hz, "with --track: images per second", {1e-3, 1e4});
  add("candidates", o.candidates, "csv file of every candidate and what became of it");
  add("overlay", o.overlay, "folder for pictures of what happened to each candidate");
  add.unnamed.add("input", -1);
  return add;
}

constexpr double kNearlyBlackGrey = 16.0;  // brightest value: 12 bits, read as the lower of 16

// A file with another name would be an image or a parameter file, which would be lost.
void checkTable(const char* option, const std::string& file) {
  const std::string extension = fs::path(file).extension().string();
  if (!extension.empty() && extension != ".csv")
    throw InputError(std::string(option) + " " + file + ": a csv file is written: end its name with .csv");
}

void check(const Options& o) {
  checkTable("--output", o.output);
  checkTable("--candidates", o.candidates);
  if (o.candidates == o.output) throw InputError("--candidates " + o.candidates + ": is also --output");
  if (o.inputs.empty()) throw InputError("no image given; see --help");
  if (!o.size.empty() && o.camera.empty())
    throw InputError("--window-size needs --camera: no pose without it");
  if (!o.corners.empty() && o.reference.empty()) throw InputError("--reference-corners needs --reference");
}

std::vector<std::string> listImages(const std::vector<std::string>& inputs) {
  std::vector<std::string> images;
  for (const std::string& input : inputs) {
    if (!fs::exists(input)) throw InputError(input + ": no such file or folder");
    if (!fs::is_directory(input)) {
      images.push_back(input);
      continue;
    }
    std::vector<std::string> found, others;
    for (const auto& entry : fs::directory_iterator(input))
      if (entry.is_regular_file())
        (evaluation::looksLikeImage(entry.path()) ? found : others).push_back(entry.path().string());
    if (found.empty()) throw InputError(input + ": no image in this folder; folders in it are not searched");
    if (!others.empty())
      std::cerr << "detect_images: " << input << ": left out " << others.size()
                << " whose names do not end as an image's, e.g. "
                << *std::min_element(others.begin(), others.end()) << "\n";
    std::sort(found.begin(), found.end());
    images.insert(images.end(), found.begin(), found.end());
  }
  return images;
}

// An overlay has the same name as its photograph.
void checkOverlays(const Options& o, const std::vector<std::string>& images) {
  for (const std::string& input : o.inputs)  // the next run would treat the overlays as photographs
    if (fs::is_directory(input) && fs::exists(o.overlay) && fs::equivalent(input, o.overlay))
      throw InputError("--overlay " + o.overlay + ": the input images are there: give another folder");
  std::map<fs::path, std::string> named;
  for (const std::string& file : images)
    if (const auto [other, is_new] = named.emplace(fs::path(file).filename(), file);
        !is_new && other->second != file)
      throw InputError("--overlay " + o.overlay + ": one picture for both " + other->second + " and " + file +
                       ": run each folder by itself");
}

detection::ReferenceAppearance readReference(const std::string& file, const std::vector<double>& v,
                                             const detection::DetectorParams& params) {
  const cv::Mat image = evaluation::readImage(file);
  if (v.empty()) return detection::referenceFromImage(image, params);
  const auto quad = geometry::canonical({Eigen::Vector2d(v[0], v[1]), Eigen::Vector2d(v[2], v[3]),
                                         Eigen::Vector2d(v[4], v[5]), Eigen::Vector2d(v[6], v[7])});
  if (!quad) throw InputError("--reference-corners: not a convex quadrilateral");
  if (const std::string fault = detection::ReferenceAppearance::faultOf(image, *quad); !fault.empty())
    throw InputError("--reference-corners: " + fault);
  return detection::ReferenceAppearance(image, *quad);
}

Job prepare(const Options& o) {
  Job job;
  std::string reference = o.reference;
  std::vector<double> corners;
  if (!o.corners.empty()) corners = numbers("--reference-corners", o.corners, 8);
  job.params = tools::readParams(o.params, reference, corners);
  if (!o.camera.empty()) job.camera = parameters::readCalibrationFile(o.camera);
  if (!reference.empty()) job.reference = readReference(reference, corners, job.params);
  if (!reference.empty() && corners.empty())
    std::cerr << "detect_images: warning: " << tools::kGuessedOpening << "\n";
  if (!o.size.empty()) {
    estimation::PoseParams params;
    tools::takeWindowSize("--window-size", o.size, params);
    if (job.camera) job.estimator.emplace(params);
    if (job.reference && !corners.empty())
      if (const auto other = tools::otherAspect(geometry::aspectRatio(job.reference->opening()), params);
          !other.empty())
        std::cerr << "detect_images: warning: " << other << "\n";
  }
  return job;
}

// Whether a JPEG's end is missing: OpenCV leaves the rest grey. What follows the end, e.g. a video, does not
// count, nor does the end of a preview within a segment.
bool isCutJpeg(const std::string& bytes) {
  if (bytes.size() < 4 || bytes.rfind("\xFF\xD8", 0) != 0) return false;
  for (std::size_t at = 2; (at = bytes.find('\xFF', at)) < bytes.size() - 3;) {
    const auto byte = [&](int i) { return static_cast<unsigned char>(bytes[at + i]); };
    if (byte(1) == 0xD9) return false;
    const bool is_segment = byte(1) >= 0xC0 && byte(1) < 0xFF && (byte(1) < 0xD0 || byte(1) > 0xD7);
    at += is_segment ? 2 + 256 * byte(2) + byte(3) : byte(1) == 0xFF ? 1 : 2;
  }
  return bytes.substr(bytes.size() - 2) != "\xFF\xD9";
}

bool fitsCamera(const cv::Mat& image, const Job& job) {
  return job.camera && job.camera->width == image.cols && job.camera->height == image.rows;
}

evaluation::DetectionRow process(const cv::Mat& image, const Job& job, WindowFinder& finder) {
  evaluation::DetectionRow row;
  const bool fits = fitsCamera(image, job);
  const auto start = Clock::now();
  row.window = finder.find(image, fits ? &*job.camera : nullptr);
  if (!row.window) row.reject_reason = detection::toString(finder.trace().outcome);
  const bool wants_pose = row.window && row.window->whole() && job.estimator;
  if (wants_pose && !fits) row.reject_reason = "pose_camera_size";
  if (wants_pose && fits) {
    const estimation::PoseResult result = job.estimator->estimate(*row.window, *job.camera);
    row.pose = result.estimate;
    if (!row.pose) row.reject_reason = std::string("pose_") + estimation::toString(result.reject);
  }
  row.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return row;
}

void writeOverlay(const std::string& file, const cv::Mat& image, const WindowFinder& finder,
                  const evaluation::DetectionRow& row, const std::string& folder) {
  cv::Mat canvas;
  detection::drawDetection(image, finder.trace(), row.window ? &*row.window : nullptr, canvas,
                           row.milliseconds);
  if (row.pose && row.window)
    detection::drawYaw(canvas, *row.window,
                       geometry::yawText(row.pose->yaw_rad, row.pose->yaw_sigma_rad, row.pose->sign_trusted));
  evaluation::writeImage(fs::path(folder) / (fs::path(file).filename().string() + ".png"), canvas);
}

int run(const Options& o) {
  check(o);
  const std::vector<std::string> images = listImages(o.inputs);
  if (!o.overlay.empty()) checkOverlays(o, images);
  const Job job = prepare(o);
  if (!o.overlay.empty()) tools::makeFolder(o.overlay);
  WindowFinder finder(job.params, job.reference, o.track ? o.rate_hz : 0.0);
  evaluation::OutputFile output(o.output, "file," + evaluation::detectionColumns() + finder.columns()),
      candidates;
  if (!o.candidates.empty()) candidates.open(o.candidates, "file," + evaluation::candidateColumns());
  int unreadable = 0, found = 0, not_compared = 0, other_size = 0;
  tools::Progress progress("detect_images", "images", images.size());
  for (const std::string& file : images) {
    const bool is_cut = isCutJpeg(tools::contentOf(file));
    const cv::Mat image = is_cut ? cv::Mat() : evaluation::imageOrNone(file);
    evaluation::DetectionRow row;
    if (image.empty()) {
      ++unreadable;
      finder.skip();
      row.reject_reason = "unreadable";
      std::cerr << "detect_images: " << file
                << (is_cut ? ": its end is missing" : ": cannot be read as an image") << "; skipped"
                << std::endl;
    } else {
      if (cv::norm(image, cv::NORM_INF) < kNearlyBlackGrey)
        std::cerr << "detect_images: warning: " << file
                  << " is nearly black; 12 bits in a 16-bit file? then scale it\n";
      row = process(image, job, finder);
      found += row.window.has_value();
      other_size += job.camera && !fitsCamera(image, job);
      not_compared += job.reference && row.window && !row.window->has_appearance;
      if (candidates.is_open()) {
        candidates << evaluation::candidateRows(evaluation::csvField(file), finder.trace());
        candidates.finish();
      }
      if (!o.overlay.empty()) writeOverlay(file, image, finder, row, o.overlay);
    }
    output << evaluation::csvField(file) << "," << evaluation::detectionValues(row) << finder.values(row)
           << "\n";
    output.finish();
    progress.passed();
  }
  if (other_size > 0)
    std::cerr << "detect_images: warning: " << other_size << " without lens and pose: not "
              << job.camera->width << " x " << job.camera->height << " px, as --camera says\n";
  if (not_compared > 0)
    std::cerr << "detect_images: warning: " << not_compared
              << " found by geometry alone: image and reference must both have colours, or both none\n";
  std::cout << "a window in " << found << " of " << images.size() << " images; see " << o.output
            << (o.overlay.empty() ? "" : " and " + o.overlay)
            << (job.reference ? "" : " (any window: no --reference)") << std::endl;
  return unreadable ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) { return tools::runTool("detect_images", argc, argv, describe, run); }
