/// Finds the window in single pictures; one csv row each. See --help.
#include <algorithm>
#include <boost/program_options.hpp>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "command_line.hpp"
#include "window_ingress/detection/debug_image.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/parameters/calibration_file.hpp"
#include "window_ingress/evaluation/detection_table.hpp"
#include "window_ingress/parameters/yaml.hpp"
#include "window_ingress/pose/window_pose_estimator.hpp"

namespace fs = std::filesystem;
namespace po = boost::program_options;
using namespace window_ingress;
using tools::numbers;
using tools::UsageError;

namespace {

using Clock = std::chrono::steady_clock;

/// The input is fine, the work failed: one line, exit code 1.
class JobError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Options {
  std::vector<std::string> inputs;
  std::string output, camera, reference, corners, size, params, overlay;
};

/// What is the same for all pictures.
struct Job {
  detection::DetectorParams params;
  std::optional<geometry::PinholeCamera> camera;
  std::optional<detection::ReferenceAppearance> reference;
  std::optional<pose::WindowPoseEstimator> estimator;
  std::string overlay;
};

Options parse(int argc, char** argv) {
  Options o;
  po::options_description named(
      "Usage: detect_images --output OUT.csv [options] FILE_OR_DIR...\n"
      "Finds the window in each picture and writes one csv row a picture, in the order given.\n"
      "Exit code: 0 done, 1 some picture could not be read, 2 wrong usage or unreadable input.\n\nOptions");
  named.add_options()("help,h", "this text")                                                              //
      ("output,o", po::value(&o.output), "csv file to write")                                             //
      ("camera", po::value(&o.camera), "calibration, yaml of camera_info_manager")                        //
      ("reference", po::value(&o.reference), "picture of the target with its frame")                      //
      ("reference-corners", po::value(&o.corners), "x1,y1,...,x4,y4: inner border of the opening in it")  //
      ("window-size", po::value(&o.size), "W,H: inner size of the opening [m]; with --camera: poses")     //
      ("params", po::value(&o.params), "yaml file with a section 'detector'")                             //
      ("overlay", po::value(&o.overlay), "folder for pictures of what happened to each candidate");
  po::options_description all;
  all.add(named).add_options()("input", po::value(&o.inputs), "");
  po::positional_options_description positional;
  positional.add("input", -1);
  po::variables_map values;
  try {
    po::store(po::command_line_parser(argc, argv).options(all).positional(positional).run(), values);
    po::notify(values);
  } catch (const po::error& error) {
    throw UsageError(std::string(error.what()) + "; see --help");
  }
  if (values.count("help")) {
    std::cout << named << std::endl;
    std::exit(0);
  }
  if (o.output.empty()) throw UsageError("--output is missing; see --help");
  if (o.inputs.empty()) throw UsageError("no picture given; see --help");
  if (!o.corners.empty() && o.reference.empty()) throw UsageError("--reference-corners needs --reference");
  return o;
}

bool looksLikePicture(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  for (const char* known : {".jpg", ".jpeg", ".png", ".bmp", ".tif", ".tiff", ".ppm", ".pgm"})
    if (extension == known) return true;
  return false;
}

std::vector<std::string> listPictures(const std::vector<std::string>& inputs) {
  std::vector<std::string> pictures;
  for (const std::string& input : inputs) {
    if (!fs::exists(input)) throw UsageError(input + ": no such file or folder");
    if (!fs::is_directory(input)) {
      pictures.push_back(input);
      continue;
    }
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(input))
      if (entry.is_regular_file() && looksLikePicture(entry.path())) found.push_back(entry.path().string());
    if (found.empty()) throw UsageError(input + ": no picture in this folder");
    std::sort(found.begin(), found.end());
    pictures.insert(pictures.end(), found.begin(), found.end());
  }
  return pictures;
}

cv::Mat readPicture(const std::string& file) {
  try {
    return cv::imread(file, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    return {};
  }
}

detection::ReferenceAppearance readReference(const Options& o, const detection::DetectorParams& params) {
  const cv::Mat picture = fs::exists(o.reference) ? readPicture(o.reference) : cv::Mat();
  if (picture.empty())
    throw UsageError(o.reference + ": cannot be read as a picture; give --reference a photograph");
  if (o.corners.empty()) return detection::referenceFromPicture(picture, params);
  const auto v = numbers("--reference-corners", o.corners, 8);
  const auto quad = geometry::canonical({Eigen::Vector2d(v[0], v[1]), Eigen::Vector2d(v[2], v[3]),
                                         Eigen::Vector2d(v[4], v[5]), Eigen::Vector2d(v[6], v[7])});
  if (!quad) throw UsageError("--reference-corners: '" + o.corners + "' is no convex quadrilateral");
  return detection::ReferenceAppearance(picture, *quad);
}

Job prepare(const Options& o) {
  Job job;
  if (!o.params.empty() && !parameters::readYamlFile(o.params, "detector", job.params))
    throw UsageError(o.params + ": no section 'detector' in this file");
  if (!o.camera.empty()) job.camera = parameters::readCalibrationFile(o.camera);
  if (!o.reference.empty()) job.reference = readReference(o, job.params);
  if (!o.size.empty()) {
    pose::PoseParams params;
    const auto size = numbers("--window-size", o.size, 2);
    params.opening_width_m = size[0], params.opening_height_m = size[1];
    if (job.camera) job.estimator.emplace(params);
  }
  job.overlay = o.overlay;
  if (!o.overlay.empty()) fs::create_directories(o.overlay);
  return job;
}

evaluation::DetectionRow process(const cv::Mat& picture, const Job& job,
                                 detection::WindowDetector& detector) {
  evaluation::DetectionRow row;
  const bool fits = job.camera && job.camera->width == picture.cols && job.camera->height == picture.rows;
  const auto start = Clock::now();
  row.window = detector.detect(picture, 0.0, fits ? &*job.camera : nullptr);
  if (!row.window) row.reject_reason = detection::toString(detector.trace().outcome);
  if (row.window && job.estimator) {
    if (fits) {
      const pose::PoseResult result = job.estimator->estimate(*row.window, *job.camera);
      row.pose = result.estimate;
      if (!row.pose) row.reject_reason = std::string("pose_") + pose::toString(result.reject);
    } else {
      row.reject_reason = "pose_camera_size";
    }
  }
  row.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return row;
}

void writeOverlay(const std::string& file, const cv::Mat& picture, const detection::WindowDetector& detector,
                  const evaluation::DetectionRow& row, const std::string& folder) {
  cv::Mat canvas;
  detection::drawDetection(picture, detector.trace(), row.window ? &*row.window : nullptr, canvas);
  const fs::path target = fs::path(folder) / (fs::path(file).filename().string() + ".png");
  if (!cv::imwrite(target.string(), canvas))
    throw JobError(target.string() + ": cannot be written; is the disk full?");
}

int run(const Options& options) {
  const std::vector<std::string> pictures = listPictures(options.inputs);
  const Job job = prepare(options);
  detection::WindowDetector detector(job.params);
  if (job.reference) detector.setReference(*job.reference);
  const fs::path folder = fs::path(options.output).parent_path();
  if (!folder.empty()) fs::create_directories(folder);
  std::ofstream output(options.output);
  if (!output) throw UsageError(options.output + ": cannot be written");
  output << "file," << evaluation::detectionColumns() << "\n";
  int unreadable = 0;
  auto next_report = Clock::now() + std::chrono::seconds(5);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const cv::Mat picture = readPicture(pictures[i]);
    evaluation::DetectionRow row;
    if (picture.empty()) {
      ++unreadable;
      row.reject_reason = "unreadable";
      std::cerr << "detect_images: " << pictures[i] << ": cannot be read as a picture; skipped" << std::endl;
    } else {
      row = process(picture, job, detector);
      if (!job.overlay.empty()) writeOverlay(pictures[i], picture, detector, row, job.overlay);
    }
    output << evaluation::csvField(pictures[i]) << "," << evaluation::detectionValues(row) << "\n";
    if (Clock::now() < next_report) continue;
    next_report += std::chrono::seconds(5);
    std::cerr << "detect_images: " << i + 1 << " of " << pictures.size() << " pictures" << std::endl;
  }
  output.flush();
  if (!output) throw JobError(options.output + ": writing failed; is the disk full?");
  return unreadable ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const auto fail = [](const std::exception& error, int code) {
    std::cerr << "detect_images: " << error.what() << std::endl;
    return code;
  };
  try {
    return run(parse(argc, argv));
  } catch (const JobError& error) {
    return fail(error, 1);
  } catch (const std::exception& error) {
    return fail(error, 2);
  }
}
