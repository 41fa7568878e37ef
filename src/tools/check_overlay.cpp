/// Checks whether a file may override the defaults; see --help. Launch files call it before they start nodes.
#include <ros/package.h>

#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <filesystem>
#include <iostream>
#include <regex>
#include <string>
#include <vector>

#include "adapters/images/image_source.hpp"
#include "adapters/images/reference_source.hpp"
#include "adapters/pose/camera_mounting.hpp"
#include "adapters/runtime/parameter_server.hpp"
#include "command_line.hpp"
#include "display.hpp"
#include "launch_checks.hpp"
#include "navigation/mission/start_conditions.hpp"
#include "params_file.hpp"
#include "recorded_topics.hpp"
#include "simulation/scenario/scenario.hpp"
#include "size_checks.hpp"
#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/text/text.hpp"

namespace {

using namespace window_ingress;

// As in launch files: may be surrounded by brackets and blanks.
std::string given(const std::string& text) {
  const std::string inside = boost::trim_copy_if(text, boost::is_any_of(" []"));
  return inside == "none" ? "" : inside;
}

struct Options {
  std::string file, defaults, reference, corners, window_size, camera_pose, needs_window_size, fly,
      image_transport, odom_frame, needs_package, needs_display, scenario, flown_by, print, launch_folder,
      record, bag, plays;
  std::uint32_t seed = 1;

  // A vehicle flies that is not in this package's simulation.
  bool asksForSizes() const { return needs_window_size == "true" || needs_window_size == "warn"; }
  // sim.launch: what the file does not give the scenario does, and checkScenario looks at it.
  bool isSimulated() const { return !given(defaults).empty(); }
  bool isByHand() const { return launch_folder.empty() && fly.empty() && bag.empty(); }
};

tools::OptionList describe(Options& o) {
  tools::OptionList add(
      "Usage: check_overlay [FILE.yaml] [OPTION...]\n"
      "Checks a parameter file for config:= of launch files and --params of tools: each key must\n"
      "exist, each value must be in range. Prints the file's name if it is valid, otherwise all errors.\n"
      "Launch files call this before they start anything; the options are their arguments. 'none' means\n"
      "not given.\n"
      "Exit code: 0 the file can be used, 2 it cannot.");
  add("file", o.file, "the same as FILE.yaml");
  add("reference", o.reference, "image of the target");
  add("reference-corners", o.corners, "x1,y1,...,x4,y4 in it [px]");
  add("window-size", o.window_size, "W,H of the opening [m]");
  add("needs-window-size", o.needs_window_size,
      "true: a missing size of the opening is an error; warn: a warning; both warn if the vehicle's size or "
      "the reference is missing");
  add("image-transport", o.image_transport, "how images are transported, e.g. raw");
  add("odom-frame", o.odom_frame, "frame_id of the odometry");
  add("scenario", o.scenario, "yaml file of the simulated world");
  add("seed", o.seed, "of the simulated world", {0, 2147483647});
  add("flown-by", o.flown_by, "parameter file whose sizes fly in the simulated world instead of its own");
  add("print", o.print, "prints nothing but this size, e.g. vehicle/half_width_m, as flown in the scenario");
  add("record", o.record, "bag file to write; must not exist yet");
  add("bag", o.bag, "bag file to play; several separated by blanks");
  add("plays", o.plays,
      "NAME=TOPIC, separated by blanks: arguments of replay.launch; an error if the bag has other topics "
      "instead");
  add("needs-package", o.needs_package, "from which the calling roslaunch starts a node");
  add("needs-display", o.needs_display, "true: the calling roslaunch starts rviz");
  add("defaults", o.defaults, "yaml file whose values FILE.yaml overrides");
  add("fly", o.fly, "true: a vehicle that does not fit through the opening is an error");
  add("launch-folder", o.launch_folder,
      "the package's folder of launch files: arguments of the calling roslaunch are checked against its file "
      "there");
  add("camera-pose", o.camera_pose, "x,y,z,yaw,pitch,roll in base_link [m, rad]");
  add.unnamed.add("file", 1);
  return add;
}

/// \return width over height of the opening in the reference image; 0: not given
double checkReference(const Options& o, const std::string& file,
                      const configuration::DetectorNodeParams& detector) {
  configuration::ReferenceParams reference = detector.reference;
  const std::string image = given(o.reference), corners = given(o.corners);
  const bool in_file = image.empty() && corners.empty();
  const std::string from = in_file ? file + ": window_detector/" : "";
  if (!image.empty()) reference.picture = image, reference.corners.clear();
  if (!corners.empty()) reference.corners = tools::numbers("reference_corners", corners, 8);
  if (reference.picture.empty()) {
    if (!reference.corners.empty())
      throw InputError(from + "reference corners without their image: give reference:= as well");
    if (o.asksForSizes())
      tools::warn(
          "no reference image (reference:=, or window_detector/reference in the file): unless one comes on "
          "/reference, the detector may lock onto another window or a decoy");
    return 0.0;
  }
  if (!std::filesystem::path(reference.picture).is_absolute())
    throw InputError((in_file ? from + "reference/picture: " : "reference:=") + reference.picture + ": " +
                     tools::wholePathOf(reference.picture));
  try {
    const auto opening = adapters::loadReference(reference, detector.detector).opening();
    if (!reference.corners.empty()) return geometry::aspectRatio(opening);
    tools::warn(tools::kGuessedOpening);
    return 0.0;
  } catch (const InputError& error) {
    throw InputError(from + error.what());
  }
}

void checkTransport(const Options& o, const std::string& file, const configuration::Overlay& overlay) {
  const char* key = "window_detector/image_transport";
  const std::string& in_file = overlay.window_detector.image_transport;
  const std::string& transport = overlay.gives(key) ? in_file : o.image_transport;
  const std::string why = transport.empty() ? "" : adapters::whyNoTransport(transport);
  if (!why.empty()) throw InputError(why);
  if (overlay.gives(key)) tools::checkAgrees("image_transport", o.image_transport, file, key, in_file);
}

void checkSpeeds(const configuration::Overlay& overlay) {
  const auto check = [](const char* limit, double guarded, const char* name, double told) {
    if (told >= guarded)
      tools::warn(
          formatted("setpoint_guard/%s %g is not above ingress_navigator/navigator/limits/%s %g: the guard "
                    "replaces faster setpoints by zero",
                    limit, guarded, name, told));
  };
  const auto& limits = overlay.ingress_navigator.navigator.limits;
  const auto& guard = overlay.setpoint_guard;
  check("max_speed_mps", guard.max_speed_mps, "speed_mps", limits.speed_mps);
  check("max_yaw_rate_radps", guard.max_yaw_rate_radps, "yaw_rate_radps", limits.yaw_rate_radps);
}

void checkCameraPose(const std::string& text, const navigation::VehicleParams& vehicle) {
  if (text.empty()) return;
  const std::vector<double> pose = tools::numbers("camera_pose", text, 6);
  try {
    const std::string why = navigation::whyNotMounted(adapters::T_base_cameraOf(pose), vehicle);
    if (!why.empty()) throw InputError(why);
  } catch (const InputError& error) {
    throw InputError("camera_pose " + text + ": " + error.what());
  }
}

// Rejects values that contradict each other.
void checkNavigator(const std::string& file, const navigation::NavigatorParams& params) {
  try {
    navigation::checked(params);
  } catch (const std::invalid_argument& error) {
    throw InputError(file + ": ingress_navigator/" + error.what());
  }
}

void checkInstalled(const std::string& package) {
  std::vector<std::string> all;
  if (package.empty() || !ros::package::getAll(all) ||
      std::find(all.begin(), all.end(), package) != all.end())
    return;
  std::string name = package;
  std::replace(name.begin(), name.end(), '_', '-');
  throw InputError(
      "the package " + package + " is not installed: apt install ros-noetic-" + name +
      ", on Debian build it in your workspace; or start another driver (rehearse.launch: camera:=false)");
}

void checkLaunch(const Options& o, tools::InputFaults& faults) {
  const auto words = tools::wordsOfParent();
  const auto file = tools::launchFileOf(words, o.launch_folder);
  if (file.empty()) return;
  faults.collect([&] { tools::checkLaunchArguments(words, file); });
  std::vector<const char*> nodes;  // of ingress.launch only
  if (!o.fly.empty()) nodes = {"/window_detector", "/homography_pose"};
  if (o.fly == "true") nodes.insert(nodes.end(), {"/ingress_navigator", "/setpoint_guard"});
  faults.collect([&] { tools::checkNoneRuns(words, nodes); });
  if (tools::startsNothing(words)) return;
  faults.collect([&] { tools::checkFilesAreThere(words, file); });
  faults.collect([&] { checkInstalled(o.needs_package); });
  if (o.needs_display == "true" && !tools::hasDisplay())
    faults.collect([] {
      throw InputError(
          "rviz has no display: export DISPLAY=:0 on a machine with a screen, or, if the launch file has it, "
          "rviz:=false");
    });
}

// A scenario in place of a parameter file names no node, and has fewer faults as a scenario.
void checkIsNoScenario(const std::string& file, const std::string& faults) {
  static const std::regex kNode("(window_detector|_pose|_navigator|_guard|world) *:");
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  if (std::regex_search(tools::contentOf(file), kNode)) return;
  try {
    simulation::loadScenario(file, 1);
  } catch (const InputError& fault) {
    if (lines(fault.what()) >= lines(faults)) return;
  }
  throw InputError(file +
                   ": is a scenario, no parameter file: launch files take it as scenario:=, tools, "
                   "check-config too, as --scenario");
}

// rosbag replaces an existing file without a warning.
void checkIsNew(const std::string& bag) {
  if (!bag.empty() && std::filesystem::exists(bag))
    throw InputError("record:=" + bag +
                     " is there already: overwrite:=true replaces it, or give another name");
}

void checkOverlay(const Options& o, const std::string& file, configuration::Overlay& overlay,
                  tools::InputFaults& faults) {
  double aspect = 0.0;
  faults.collect([&] { aspect = checkReference(o, file, overlay.window_detector); });
  faults.collect([&] { checkTransport(o, file, overlay); });
  if (const char* key = "vehicle/odom_frame"; overlay.gives(key))
    faults.collect(
        [&] { tools::checkAgrees("odom_frame", o.odom_frame, file, key, overlay.vehicle.frames.odom); });
  faults.collect([&] { tools::overrideWindowSize(given(o.window_size), file, overlay); });
  const bool gives_opening = tools::givesOpening(overlay);
  if (aspect > 0.0 && gives_opening)
    if (const auto other = tools::otherAspect(aspect, overlay.homography_pose.pose); !other.empty())
      tools::warn(other);
  checkSpeeds(overlay);
  if (o.asksForSizes())
    faults.collect([&] { tools::checkOpeningIsGiven(overlay, o.needs_window_size == "true"); });
  else if (!o.isSimulated())
    tools::checkBothSides(overlay);
  if (o.isByHand() ? gives_opening : o.asksForSizes() && o.fly == "true") tools::checkVehicleIsGiven(overlay);
  faults.collect([&] { checkNavigator(file, overlay.ingress_navigator.navigator); });
  const bool gives_both =
      gives_opening && (overlay.gives("vehicle/half_width_m") || overlay.gives("vehicle/half_height_m"));
  if ((o.fly == "true" && !o.isSimulated()) || (o.fly.empty() && gives_both))
    faults.collect([&] { tools::checkFits(overlay.vehicle, overlay.homography_pose.pose); });
}

// Faults of the parameter file are reported where it is loaded.
void checkScenario(const Options& o, configuration::Overlay& overlay, tools::InputFaults& faults) {
  const auto scenario = simulation::loadScenario(o.scenario, o.seed);
  if (!o.flown_by.empty() && scenario.vehicle.profile == "external")
    throw InputError(o.scenario + ": vehicle: external is simulated elsewhere: start external.launch");
  if (!tools::InputFaults().collect([&] { overlay = tools::flownIn(scenario, given(o.flown_by)); })) return;
  if (const std::string other = tools::otherReference(overlay); !other.empty()) tools::warn(other);
  const std::string other = tools::otherSizes(overlay, scenario);
  if (other.empty()) return;
  tools::warn(other);
  faults.collect([&] { tools::checkFits(overlay.vehicle, overlay.homography_pose.pose); });
}

int check(const Options& o) {
  if ((o.file + o.reference + o.corners + o.window_size + o.camera_pose + o.needs_window_size + o.scenario +
       o.launch_folder + o.bag)
          .empty())
    throw InputError("no file given; see --help");
  if (!o.print.empty()) {
    const auto scenario = simulation::loadScenario(o.scenario, o.seed);
    std::cout << tools::sizeCalled(o.print, tools::flownIn(scenario, given(o.flown_by))) << "\n";
    return 0;
  }
  tools::InputFaults faults;
  if (!o.launch_folder.empty()) checkLaunch(o, faults);
  const std::string file = given(o.file);
  configuration::Overlay overlay;
  const bool is_read = faults.collect([&] {
    overlay = configuration::readOverlay(given(o.defaults));
    try {
      overlay = configuration::readOverlay(tools::existing(file), overlay);
    } catch (const InputError& fault) {
      checkIsNoScenario(file, fault.what());
      throw;
    }
  });
  if (is_read) checkOverlay(o, file, overlay, faults);
  faults.collect([&] { checkCameraPose(given(o.camera_pose), overlay.vehicle); });
  if (!o.scenario.empty()) faults.collect([&] { checkScenario(o, overlay, faults); });
  faults.collect([&] { checkIsNew(given(o.record)); });
  faults.collect([&] { tools::checkPlayed(o.bag, o.plays); });
  faults.throwIfAny();
  if (o.isByHand() || (o.asksForSizes() && o.fly == "true"))
    std::cerr << "check_overlay: " << tools::understood(overlay, !o.scenario.empty()) << "\n";
  std::cout << file << "\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int code = tools::runTool("check_overlay", argc, argv, describe, check);
  if (code != 0 && tools::isRoslaunch(tools::wordsOfParent()))
    std::cerr << "check_overlay: nothing is started. The message below is roslaunch's own and adds nothing\n";
  return code;
}
