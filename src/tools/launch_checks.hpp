/// Checks by check_overlay of the calling roslaunch, which accepts any argument silently and ends running
/// nodes of the same name.
#pragma once

#include <unistd.h>
#include <xmlrpcpp/XmlRpc.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "command_line.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::tools {

/// The command of the process that started this one.
inline std::vector<std::string> wordsOfParent() {
  std::istringstream stream(contentOf("/proc/" + std::to_string(getppid()) + "/cmdline"));
  std::vector<std::string> words;
  for (std::string word; std::getline(stream, word, '\0');) words.push_back(word);
  return words;
}

/// Nodes run in another folder, but this program does not: here a relative path is valid if the file exists.
inline std::string existing(const std::string& file) {
  if (!file.empty() && !std::filesystem::exists(file))
    throw InputError("config " + std::filesystem::absolute(file).string() + ": no such file");
  return file;
}

inline bool isRoslaunch(const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return std::filesystem::path(word).filename() == "roslaunch";
  });
}

/// Declaration of an argument in a launch file.
struct LaunchArgument {
  std::string name, standard, doc;
};

/// Arguments of the launch file: its own, and those of files included with pass_all_args unless it sets them.
inline std::vector<LaunchArgument> argumentsOf(const std::filesystem::path& file) {
  const std::string text = std::regex_replace(contentOf(file), std::regex("<!--[\\s\\S]*?-->"), "");
  const auto each = [&](const char* pattern, const auto& found) {
    const std::regex expression(pattern);
    for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
      found(*match);
  };
  std::vector<LaunchArgument> arguments;
  std::map<std::string, std::string> named;  // with their defaults
  each("<arg\\s+name=\"(\\w+)\"(?:\\s+(default|value)=\"([^\"]*)\")?(?:\\s+doc=\"([^\"]*)\")?",
       [&](const auto& arg) {
         std::smatch other;  // default="$(arg rviz)"
         std::string standard = arg[3];
         if (std::regex_match(standard, other, std::regex("\\$\\(arg (\\w+)\\)"))) standard = named[other[1]];
         if (const std::string here = "$(find window_ingress)"; standard.rfind(here, 0) == 0)
           standard.replace(0, here.size(), file.parent_path().parent_path().string());
         if (named.emplace(arg[1], standard).second && arg[2] != "value")
           arguments.push_back({arg[1], standard, arg[4]});
       });
  each("<include\\s+file=\"[^\"]*/(\\w+\\.launch)\"\\s+pass_all_args=\"true\"", [&](const auto& included) {
    for (const auto& argument : argumentsOf(file.parent_path() / included[1].str()))
      if (named.emplace(argument.name, argument.standard).second) arguments.push_back(argument);
  });
  return arguments;
}

inline bool isNumber(const std::string& text) {
  char* end = nullptr;
  return std::isfinite(std::strtod(text.c_str(), &end)) && end != text.c_str() && *end == '\0';
}

/// Advice about a relative path: nodes run in another folder, and only shells expand ~.
inline std::string wholePathOf(const std::string& file) {
  const char* home = std::getenv("HOME");
  const bool at_home = home && file.rfind("~/", 0) == 0;
  return "give its whole path, as " +
         (at_home ? home + file.substr(1) : (std::filesystem::current_path() / file).string());
}

/// The same for an argument; `nominal` is the file of that name beside the default one.
inline std::string wholePathOf(const std::string& file, const std::string& standard) {
  const auto shipped = std::filesystem::absolute(std::filesystem::path(standard).parent_path() / file);
  for (const char* end : {"", ".yaml"})
    if (std::filesystem::exists(shipped.string() + end))
      return "give its whole path, as " + shipped.string() + end;
  return wholePathOf(file);
}

/// Why this cannot be the argument's value; empty if it can. The argument's doc lists the allowed words ("one
/// of a, b; ..") or asks for a whole path; otherwise the default shows whether it is a switch or a number.
inline std::string whyNot(const LaunchArgument& argument, const std::string& value) {
  std::smatch listed;
  const bool is_switch = argument.standard == "true" || argument.standard == "false";
  const std::string words = is_switch ? "true, false"
                            : std::regex_search(argument.doc, listed, std::regex("\\bone of ([^;]+)"))
                                ? listed[1].str()
                                : "";
  if (!words.empty())
    return (", " + words + ",").find(", " + value + ",") == std::string::npos ? "give one of " + words : "";
  if (isNumber(argument.standard)) {
    if (!isNumber(value)) return "give a number";
    const bool must_be_above = argument.doc.find("above 0") != std::string::npos;
    return must_be_above && !(std::strtod(value.c_str(), nullptr) > 0.0) ? "give a number above 0" : "";
  }
  const bool is_path = !value.empty() && value != argument.standard && value[0] != '/';
  if (!is_path || argument.doc.find("whole path") == std::string::npos) return "";
  return wholePathOf(value, argument.standard);
}

/// The launch file in `folder` given to roslaunch; empty if the words are not those of roslaunch, or name
/// another file.
inline std::filesystem::path launchFileOf(const std::vector<std::string>& words,
                                          const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  for (const std::string& word : words)
    if (word.find(":=") == std::string::npos && fs::path(word).extension() == ".launch")
      files.emplace_back(word);
  std::error_code error;
  if (!isRoslaunch(words) || files.size() != 1) return {};
  const fs::path file = folder / files[0].filename();
  const bool is_ours =
      files[0].has_parent_path() ? fs::equivalent(files[0], file, error) : fs::exists(file, error);
  return is_ours ? file : fs::path();
}

/// The words NAME:=VALUE.
inline std::vector<std::pair<std::string, std::string>> assignmentsIn(const std::vector<std::string>& words) {
  std::vector<std::pair<std::string, std::string>> given;
  for (const auto& word : words)
    if (const auto assigned = word.find(":="); assigned != std::string::npos)
      given.emplace_back(word.substr(0, assigned), word.substr(assigned + 2));
  return given;
}

/// One file, or several separated by blanks.
inline std::vector<std::string> filesIn(const std::string& files) {
  if (std::filesystem::exists(files)) return {files};
  std::istringstream stream(files);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Why this file does not suit an argument whose doc asks for a kind of file; empty if it does.
inline std::string whyNotFile(const std::string& doc, const std::string& file) {
  if (file[0] != '/') return "";  // refused elsewhere as a relative path
  if (!std::filesystem::exists(file)) return "no such file";
  std::string beginning(8, ' ');
  std::ifstream(file, std::ios::binary).read(beginning.data(), 8);
  return doc.rfind("existing bag ", 0) == 0 && beginning != "#ROSBAG " ? "is no bag file" : "";
}

/// Checks an argument that is also used outside the nodes reading the file: by the guard, rviz, or a bag
/// player.
/// \param given the argument, or empty \throws InputError if the file has another value
inline void checkAgrees(const std::string& argument, const std::string& given, const std::string& file,
                        const std::string& key, const std::string& in_file) {
  if (given.empty() || given == in_file) return;
  throw InputError(file + ": " + key + " is '" + in_file + "', but the launch argument " + argument +
                   " is '" + given + "': give " + argument + ":=" + in_file + ", or remove it from the file");
}

/// \throws InputError that names each missing or unsuitable file (file:/// values, and arguments whose doc
/// asks for an "existing" file or bag) and each missing folder (arguments whose doc says what goes "into" it)
inline void checkFilesAreThere(const std::vector<std::string>& words, const std::filesystem::path& launch) {
  std::vector<std::string> faults;
  for (const auto& argument : argumentsOf(launch))
    for (const auto& [name, value] : assignmentsIn(words)) {
      if (name != argument.name) continue;
      const std::string said = launch.filename().string() + ": " + name + ":=";
      const std::string folder = std::filesystem::path(value).parent_path();
      const bool is_url = value.rfind("file:///", 0) == 0;
      if (argument.doc.rfind("existing ", 0) == 0 || is_url)
        for (const auto& file : filesIn(is_url ? value.substr(7) : value))
          if (const auto why = whyNotFile(argument.doc, file); !why.empty())
            faults.push_back(said + file + ": " + why);
      if (argument.doc.find("into,") != std::string::npos && !folder.empty() &&
          !std::filesystem::is_directory(folder))
        faults.push_back(said + value + ": no such folder: mkdir -p " + folder);
    }
  if (!faults.empty()) throw InputError(parameters::joined(faults, "\n"));
}

/// \param words of the command that starts this launch file
/// \throws InputError with one line per invalid argument
inline void checkLaunchArguments(const std::vector<std::string>& words, const std::filesystem::path& file) {
  const auto known = argumentsOf(file);
  std::vector<std::string> names;
  for (const auto& argument : known) names.push_back(argument.name);
  const std::string launch = file.filename().string();
  std::vector<std::string> faults;
  for (const auto& [name, value] : assignmentsIn(words)) {
    if (!std::regex_match(name, std::regex("[A-Za-z]\\w*"))) continue;  // __name, /topic
    const auto argument = std::find(names.begin(), names.end(), name);
    if (argument == names.end()) {
      const std::string meant = parameters::didYouMean(name, names);
      const std::string listed = "; roslaunch --ros-args window_ingress " + launch + " lists them";
      faults.push_back(launch + " has no argument '" + name + "'" + (meant.empty() ? listed : meant));
      continue;
    }
    const std::string why = whyNot(known[static_cast<std::size_t>(argument - names.begin())], value);
    if (!why.empty()) faults.push_back(launch + ": " + name + ":=" + value + ": " + why);
  }
  if (!faults.empty()) throw InputError(parameters::joined(faults, "\n"));
}

/// The answer of a ROS master or node to one request; invalid if there is none.
inline XmlRpc::XmlRpcValue asked(const std::string& uri, const char* question, const char* of = nullptr) {
  std::smatch parts;
  XmlRpc::XmlRpcValue arguments, answer;
  if (!std::regex_match(uri, parts, std::regex("http://([^:/]+):(\\d+)/?"))) return {};
  arguments[0] = "/check_overlay";
  if (of != nullptr) arguments[1] = of;
  XmlRpc::XmlRpcClient client(parts[1].str().c_str(), std::atoi(parts[2].str().c_str()), "/");
  const bool answers =
      client.execute(question, arguments, answer) && answer.size() == 3 && int(answer[0]) == 1;
  return answers ? XmlRpc::XmlRpcValue(answer[2]) : XmlRpc::XmlRpcValue();
}

/// The master used by a roslaunch with these words.
inline std::string masterOf(const std::vector<std::string>& words) {
  for (auto word = words.begin(); word != words.end(); ++word) {
    if ((*word == "-p" || *word == "--port") && word + 1 != words.end()) return "http://localhost:" + word[1];
    if (word->rfind("--port=", 0) == 0) return "http://localhost:" + word->substr(7);
  }
  const char* uri = std::getenv("ROS_MASTER_URI");
  return uri != nullptr ? uri : "";
}

inline bool startsNothing(const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return word == "--nodes" || word == "--files" || word == "--dump-params";
  });
}

/// \param words of roslaunch \throws InputError that names the first of these nodes that is already running
inline void checkNoneRuns(const std::vector<std::string>& words, const std::vector<const char*>& nodes) {
  if (startsNothing(words)) return;
  const char* name_space = std::getenv("ROS_NAMESPACE");
  if (name_space != nullptr && *name_space != '\0') return;
  const std::string master = masterOf(words);
  for (const char* node : nodes) {
    const auto uri = asked(master, "lookupNode", node);
    if (!uri.valid() || !asked(std::string(XmlRpc::XmlRpcValue(uri)), "getPid").valid()) continue;
    throw InputError(
        std::string(node) + " runs already at " + master +
        ": this launch would end it. End the other launch first, or take another master: roslaunch -p PORT");
  }
}

/// All faults, to be reported together.
class InputFaults {
 public:
  template <typename Step>
  bool collect(const Step& step) {
    try {
      step();
      return true;
    } catch (const InputError& fault) {
      add(fault.what());
    }
    return false;
  }
  void throwIfAny() const {
    if (!texts_.empty()) throw InputError(parameters::joined(texts_, "\n"));
  }

 private:
  // Skips a fault whose text is part of one already listed.
  void add(const std::string& text) {
    const auto says_it = [&](const std::string& told) { return told.find(text) != std::string::npos; };
    if (std::none_of(texts_.begin(), texts_.end(), says_it)) texts_.push_back(text);
  }

  std::vector<std::string> texts_;
};

}  // namespace window_ingress::tools
