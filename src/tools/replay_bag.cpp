/// Detector, pose and filter over a bag; one csv row a picture, and a plot. See --help.
#include <sys/wait.h>
#include <unistd.h>

#include <boost/program_options.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "adapters/detector_node.hpp"
#include "adapters/parameters.hpp"
#include "adapters/replay.hpp"
#include "command_line.hpp"
#include "window_ingress/evaluation/truth_comparison.hpp"
#include "window_ingress/parameters/yaml.hpp"

namespace fs = std::filesystem;
namespace po = boost::program_options;
using namespace window_ingress;
using tools::numbers;
using tools::UsageError;

namespace {

struct Options {
  std::string bag, output, size, params, corners;
  adapters::BagTopics topics;
  adapters::ReferenceParams reference;
};

Options parse(int argc, char** argv) {
  Options o;
  po::options_description named(
      "Usage: replay_bag --bag FILE.bag --output DIR [options]\n"
      "Runs detector, pose and filter over a bag; writes DIR/frames.csv and DIR/replay.png.\n"
      "Exit code: 0 done, 1 the job failed, 2 wrong usage or unreadable input.\n\nOptions");
  named.add_options()("help,h", "this text")                                                              //
      ("bag", po::value(&o.bag)->required(), "bag to read")                                               //
      ("output,o", po::value(&o.output)->required(), "folder to write into")                              //
      ("image", po::value(&o.topics.image), "topic; else the only one of its type")                       //
      ("camera-info", po::value(&o.topics.camera_info), "likewise")                                       //
      ("odom", po::value(&o.topics.odom), "likewise")                                                     //
      ("imu", po::value(&o.topics.imu), "likewise")                                                       //
      ("reference", po::value(&o.reference.picture), "picture of the target with its frame")              //
      ("reference-corners", po::value(&o.corners), "x1,y1,...,x4,y4: inner border of the opening in it")  //
      ("window-size", po::value(&o.size), "W,H: inner size of the opening [m]; without it no poses")      //
      ("params", po::value(&o.params), "yaml file with sections 'detector', 'pose', 'filter', 'tracker', 'interior'")            //
      ("truth", po::value(&o.topics.truth), "PoseStamped with the true T_camera_window, by stamp");
  po::variables_map values;
  try {
    po::store(po::command_line_parser(argc, argv).options(named).run(), values);
    if (values.count("help") > 0) {
      std::cout << named << std::endl;
      std::exit(0);
    }
    po::notify(values);
  } catch (const po::error& error) {
    throw UsageError(std::string(error.what()) + "; see --help");
  }
  if (!o.corners.empty() && o.reference.picture.empty())
    throw UsageError("--reference-corners needs --reference");
  if (!o.topics.truth.empty() && o.size.empty()) throw UsageError("--truth needs --window-size");
  if (!o.corners.empty()) o.reference.corners = numbers("--reference-corners", o.corners, 8);
  return o;
}

adapters::ReplayParams prepare(const Options& o, const rosbag::Bag& bag) {
  adapters::ReplayParams params;
  params.topics = adapters::chooseTopics(bag, o.topics);
  if (!o.params.empty()) {
    parameters::readYamlFile(o.params, "detector", params.detector);
    parameters::readYamlFile(o.params, "pose", params.pose);
    parameters::readYamlFile(o.params, "filter", params.filter);
    parameters::readYamlFile(o.params, "tracker", params.tracker);
    parameters::readYamlFile(o.params, "interior", params.interior);
  }
  if (!o.reference.picture.empty()) params.reference = adapters::loadReference(o.reference, params.detector);
  params.with_pose = !o.size.empty();
  if (!params.with_pose) return params;
  const std::vector<double> size = numbers("--window-size", o.size, 2);
  params.pose.opening_width_m = size[0];
  params.pose.opening_height_m = size[1];
  const auto faults = parameters::outOfRange(params.pose);
  if (!faults.empty()) throw UsageError("--window-size: " + parameters::joined(faults));
  return params;
}

std::string text(const char* format, double value) {
  char buffer[48];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// Seconds with all nine decimals, which a double has not.
std::string exact(const ros::Time& stamp) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%u.%09u", stamp.sec, stamp.nsec);
  return buffer;
}

constexpr const char* kFilteredColumns =
    ",filtered_qx,filtered_qy,filtered_qz,filtered_qw,filtered_tx,filtered_ty,filtered_tz,filtered_sigma_x,"
    "filtered_sigma_y,filtered_sigma_z,filtered_sigma_roll,filtered_sigma_pitch,filtered_sigma_yaw";
constexpr const char* kTruthColumns =
    ",truth_whole,truth_iou,truth_distance_m,truth_yaw_rad,error_yaw_rad,error_distance_m,error_corner_px";

std::string filteredValues(const std::optional<pose::FilteredWindow>& filtered) {
  if (!filtered) return std::string(13, ',');
  const Eigen::Quaterniond q(filtered->T_odom_window.linear());
  const Eigen::Vector3d t = filtered->T_odom_window.translation();
  std::string values;
  for (const double value : {q.x(), q.y(), q.z(), q.w()}) values += "," + text("%.9f", value);
  for (const double value : {t.x(), t.y(), t.z()}) values += "," + text("%.6f", value);
  for (int i = 0; i < 6; ++i)
    values += "," + text("%.6f", std::sqrt(std::max(0.0, filtered->covariance(i, i))));
  return values;
}

std::string truthValues(const evaluation::TruthErrors& errors) {
  std::string values = errors.whole ? ",1" : ",0";
  for (const double value : {errors.iou, errors.true_distance_m, errors.true_yaw_rad})
    values += "," + text("%.6f", value);
  for (const auto& value : {errors.yaw_rad, errors.distance_m})
    values += value ? "," + text("%.6f", *value) : ",";
  if (!errors.found || !errors.truth) return values + ",";
  return values + "," + text("%.4f", evaluation::worstCornerDistance(*errors.found, *errors.truth));
}

/// The time that an image took is not of the bag: its column stays empty.
std::string withoutMilliseconds(const std::string& values) { return values.substr(0, values.rfind(',') + 1); }

constexpr const char* kOpennessColumns = ",openness,openness_log_odds,depth_behind_m";

std::string opennessValues(const openness::OpennessVerdict& verdict) {
  return "," + std::string(openness::toString(verdict.openness)) + "," + text("%.4f", verdict.log_odds) + "," +
         (verdict.has_depth ? text("%.4f", verdict.depth_behind_m) : "");
}

class Table {
 public:
  Table(const fs::path& file, const adapters::ReplayParams& params)
      : params_(params), has_truth_(!params.topics.truth.empty()), file_(file) {
    if (!file_) throw UsageError(file.string() + ": cannot be written");
    file_ << "stamp," << evaluation::detectionColumns() << kFilteredColumns
          << (has_truth_ ? kTruthColumns : "") << kOpennessColumns << "\n";
  }

  void add(const adapters::ReplayedFrame& frame) {
    file_ << exact(frame.stamp) << "," << withoutMilliseconds(evaluation::detectionValues(frame.row))
          << filteredValues(frame.filtered);
    if (has_truth_) file_ << compare(frame);
    file_ << opennessValues(frame.openness) << "\n";
  }

  void close() {
    file_.close();
    if (!file_) throw std::runtime_error("frames.csv: writing failed; is the disk full?");
  }

  const evaluation::TruthSummary& summary() const { return summary_; }

 private:
  std::string compare(const adapters::ReplayedFrame& frame) {
    if (!frame.truth || !frame.camera) return std::string(7, ',');
    std::optional<Eigen::Isometry3d> estimate;
    if (frame.row.pose) estimate = frame.row.pose->best.T_camera_window;
    const auto errors =
        evaluation::compareWithTruth(frame.row.window, estimate, *frame.truth, *frame.camera,
                                     {params_.pose.opening_width_m, params_.pose.opening_height_m});
    summary_.add(errors);
    return truthValues(errors);
  }

  const adapters::ReplayParams& params_;
  bool has_truth_;
  std::ofstream file_;
  evaluation::TruthSummary summary_;
};

/// The script lies beside this program when installed, in scripts/ of the source tree when not. No shell in
/// between.
void plot(const fs::path& csv, const fs::path& picture) {
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  const fs::path installed = here / "plot_replay.py";
  const fs::path script =
      fs::exists(installed) ? installed : fs::path(WINDOW_INGRESS_SOURCE_DIR "/scripts/plot_replay.py");
  const pid_t child = fork();
  if (child == 0) {
    execl("/usr/bin/python3", "python3", script.c_str(), csv.c_str(), picture.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0)
    throw std::runtime_error(script.string() + " failed: no " + picture.string() +
                             "; is python3-matplotlib installed?");
}

/// rosbag reads past its buffers where an index is damaged; nothing can be caught, but it can be said.
void sayThatTheReaderCrashed(int) {
  constexpr char kText[] =
      "replay_bag: reading the bag crashed: it is damaged; see 'rosbag check' and 'rosbag reindex'\n";
  const auto written = write(STDERR_FILENO, kText, sizeof kText - 1);
  _exit(written > 0 ? 2 : 1);
}

int run(const Options& options) {
  std::signal(SIGSEGV, sayThatTheReaderCrashed);
  rosbag::Bag bag;
  adapters::openBag(bag, options.bag);
  const adapters::ReplayParams params = prepare(options, bag);
  fs::create_directories(options.output);
  const fs::path folder = options.output;
  Table table(folder / "frames.csv", params);
  int images = 0;
  auto report = std::chrono::steady_clock::now();
  const adapters::ReplaySummary summary =
      adapters::replay(bag, params, [&](const adapters::ReplayedFrame& frame) {
        table.add(frame);
        ++images;
        if (std::chrono::steady_clock::now() - report < std::chrono::seconds(5)) return;
        report = std::chrono::steady_clock::now();
        std::cerr << "replay_bag: " << images << " images" << std::endl;
      });
  table.close();
  if (summary.refused > 0)
    std::cerr << "replay_bag: " << summary.refused << " messages refused, the last one: " << summary.refusal
              << std::endl;
  if (summary.images == 0)
    throw UsageError(options.bag + ": no picture in " + params.topics.image + " can be read");
  if (params.with_pose && summary.calibrated == 0)
    throw UsageError(options.bag + ": no calibration: " + summary.refusal);
  std::cerr << "replay_bag: " << summary.images << " images, "
            << text("%.2f", summary.milliseconds / summary.images) << " ms each" << std::endl;
  if (!params.topics.truth.empty()) std::cout << table.summary().text();
  plot(folder / "frames.csv", folder / "replay.png");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse(argc, argv));
  } catch (const UsageError& error) {
    std::cerr << "replay_bag: " << error.what() << std::endl;
  } catch (const adapters::BagError& error) {
    std::cerr << "replay_bag: " << error.what() << std::endl;
  } catch (const adapters::ParameterError& error) {
    std::cerr << "replay_bag: " << error.what() << std::endl;
  } catch (const parameters::YamlError& error) {
    std::cerr << "replay_bag: " << error.what() << std::endl;
  } catch (const std::exception& error) {
    std::cerr << "replay_bag: " << error.what() << std::endl;
    return 1;
  }
  return 2;
}
