/// Detector, pose and filter over a bag; one csv row per image, and a plot. See --help.
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/bags/replay.hpp"
#include "adapters/bags/replay_output.hpp"
#include "adapters/images/reference_source.hpp"
#include "command_line.hpp"
#include "params_file.hpp"
#include "window_ingress/text/text.hpp"

namespace fs = std::filesystem;
using namespace window_ingress;
using tools::numbers;

namespace {

struct Options {
  std::string bag, output, size, params, corners;
  bool overwrite = false;
  adapters::BagTopics topics;
  adapters::ReferenceParams reference;
};

tools::OptionList describe(Options& o) {
  tools::OptionList add(
      "Usage: replay_bag --bag FILE.bag --output DIR [options]\n"
      "Runs detector, pose and filter over a bag; writes DIR/frames.csv,\n"
      "details.csv, latency.csv, replay.png, and all of it as one page: report.html.");
  add.required("bag", o.bag, "bag to read");
  add.required("output,o", o.output, "folder to write into");
  add("overwrite", o.overwrite, "replaces the replay in DIR");
  add("image", o.topics.image, "topic; default: the only one of its type");
  add("camera-info", o.topics.camera_info, "topic; default: the only one of its type");
  add("odom", o.topics.odom, "topic; default: the only one of its type");
  add("imu", o.topics.imu, "topic; default: the only one of its type");
  add("reference", o.reference.picture, "image of the target with its frame; default: that of the bag");
  add("reference-corners", o.corners, "x1,y1,...,x4,y4: inner border of the opening in it");
  add("window-size", o.size, "W,H: inner size of the opening [m]; without it, here or in --params, no poses");
  add("params", o.params, tools::kParamsHelp);
  add("truth", o.topics.truth, "PoseStamped with the true T_camera_window, by stamp");
  return add;
}

Options checked(Options o) {
  if (!o.corners.empty() && o.reference.picture.empty())
    throw InputError("--reference-corners needs --reference");
  if (!o.topics.truth.empty() && o.size.empty()) throw InputError("--truth needs --window-size");
  if (!o.overwrite && fs::exists(fs::path(o.output) / "frames.csv"))
    throw InputError(o.output + " holds an earlier replay: --overwrite replaces it, or give another folder");
  if (!o.corners.empty()) o.reference.corners = numbers("--reference-corners", o.corners, 8);
  return o;
}

void say(const std::string& line) { std::cerr << "replay_bag: " << line << std::endl; }

// MAVROS uses `map`; a frame named by the user has precedence.
void takeOdomFrame(const rosbag::Bag& bag, adapters::ReplayParams& params) {
  const std::string recorded = adapters::recordedOdomFrame(bag, params.topics.odom);
  std::string& frame = params.vehicle.frames.odom;
  if (params.gives("vehicle/odom_frame") || recorded.empty() || recorded == frame) return;
  say("odometry in the frame '" + recorded + "', as the bag has it");
  frame = recorded;
}

adapters::ReplayParams prepare(const Options& o, const rosbag::Bag& bag) {
  adapters::ReplayParams params{configuration::readOverlay(o.params), adapters::chooseTopics(bag, o.topics)};
  takeOdomFrame(bag, params);
  adapters::ReferenceParams reference = o.reference;
  tools::takeReference(o.params, params.window_detector.reference, reference.picture, reference.corners);
  if (!reference.picture.empty()) {
    params.reference = adapters::loadReference(reference, params.window_detector.detector);
    if (reference.corners.empty()) say(tools::kGuessedOpening);
  } else if ((params.reference = adapters::recordedReference(bag, params))) {
    say("the reference image is the bag's own");
  } else {
    say("no reference image in the bag or from --reference: windows are recognised by geometry only");
  }
  params.with_pose = !o.size.empty() || params.gives("homography_pose/pose/opening_width_m");
  if (!params.with_pose) say("the opening's size is missing (--window-size W,H): corners, but no poses");
  if (params.with_pose && params.topics.odom.empty())
    say("no odometry in the bag: poses of single images only");
  if (!o.size.empty()) tools::takeWindowSize("--window-size", o.size, params.homography_pose.pose);
  if (params.with_pose && !reference.corners.empty())
    if (const auto other = tools::otherAspect(geometry::aspectRatio(params.reference->opening()),
                                              params.homography_pose.pose);
        !other.empty())
      say("warning: " + other);
  return params;
}

/// The script is next to this program if installed, otherwise in tools/ of the source tree. Uses no shell.
void runScript(const std::string& name, const std::vector<std::string>& arguments) {
  const fs::path installed = fs::read_symlink("/proc/self/exe").parent_path() / name;
  const fs::path script =
      fs::exists(installed) ? installed : fs::path(WINDOW_INGRESS_SOURCE_DIR "/tools/" + name);
  std::vector<std::string> words{"python3", script.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> given;
  for (std::string& word : words) given.push_back(word.data());
  given.push_back(nullptr);
  pid_t child = 0;
  int status = 0;
  if (posix_spawn(&child, "/usr/bin/python3", nullptr, nullptr, given.data(), environ) != 0 ||
      waitpid(child, &status, 0) != child || status != 0)
    throw std::runtime_error(script.string() + " failed; is python3-matplotlib installed?");
}

/// rosbag reads past its buffers if an index is damaged; this cannot be caught, only reported.
void sayThatTheReaderCrashed(int) {
  constexpr char kText[] =
      "replay_bag: reading the bag crashed: it is damaged; see 'rosbag check' and 'rosbag reindex'\n";
  const auto written = write(STDERR_FILENO, kText, sizeof kText - 1);
  _exit(written > 0 ? 2 : 1);
}

void judge(const Options& options, const adapters::ReplayParams& params,
           const adapters::ReplaySummary& summary) {
  if (summary.refused > 0)
    say(std::to_string(summary.refused) + " messages refused, the last one: " + summary.refusal);
  if (summary.images == 0)
    throw InputError(options.bag + ": no image in " + params.topics.image + " can be read");
  if (params.with_pose && summary.calibrated == 0)
    throw InputError(options.bag + ": no calibration: " + summary.refusal);
  say(formatted("%d images, %.2f ms each on average", summary.images, summary.milliseconds / summary.images));
}

int run(const Options& options, const std::string& command) {
  std::signal(SIGSEGV, sayThatTheReaderCrashed);
  rosbag::Bag bag;
  adapters::openBag(bag, options.bag);
  const adapters::ReplayParams params = prepare(options, bag);
  const fs::path folder = options.output;
  tools::makeFolder(folder.string());
  adapters::ReplayTables tables(folder, params);
  const std::size_t images = adapters::messagesIn(bag, params.topics.image);
  adapters::DetectionStrip strip(folder, images);
  tools::Progress progress("replay_bag", "images", images);
  const auto each = [&](const adapters::ReplayedFrame& frame) {
    tables.add(frame);
    strip.add(frame);
    progress.passed();
  };
  const adapters::ReplaySummary summary = adapters::replay(bag, params, each, say);
  judge(options, params, summary);
  adapters::writeFacts(folder, command, bag, params, summary);
  if (!params.topics.truth.empty()) std::cout << tables.summary().text();
  runScript("plot_replay.py", {(folder / "frames.csv").string(), (folder / "replay.png").string()});
  runScript("report_replay.py", {folder.string()});
  say("see " + (folder / "report.html").string());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const auto body = [&](const Options& o) { return run(checked(o), adapters::commandLine(argc, argv)); };
  return tools::runTool("replay_bag", argc, argv, describe, body);
}
