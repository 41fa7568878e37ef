/// Arguments that roslaunch was given and that its launch file does not have. roslaunch takes them without a
/// word.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "window_ingress/parameters/key_list.hpp"

namespace window_ingress::tools {

inline std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The command of the process that started this one.
inline std::vector<std::string> wordsOfParent() {
  std::istringstream stream(contentOf("/proc/" + std::to_string(getppid()) + "/cmdline"));
  std::vector<std::string> words;
  for (std::string word; std::getline(stream, word, '\0');) words.push_back(word);
  return words;
}

/// What the launch file takes: its own arguments, and those of files that it includes with pass_all_args.
inline std::vector<std::string> argumentsOf(const std::filesystem::path& file) {
  const std::string text = std::regex_replace(contentOf(file), std::regex("<!--[\\s\\S]*?-->"), "");
  const auto each = [&](const char* pattern, const auto& found) {
    const std::regex expression(pattern);
    for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
      found((*match)[1].str());
  };
  std::vector<std::string> names;
  each("<arg\\s+name=\"(\\w+)\"(?!\\s+value=)", [&](const auto& name) { names.push_back(name); });
  each("<include\\s+file=\"[^\"]*/(\\w+\\.launch)\"\\s+pass_all_args=\"true\"", [&](const auto& included) {
    for (const auto& name : argumentsOf(file.parent_path() / included)) names.push_back(name);
  });
  return names;
}

/// \param words of the command that may be roslaunch with one of the launch files in `folder`
/// \throws UsageError that names the first argument it does not have
inline void checkLaunchArguments(const std::vector<std::string>& words, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  bool is_roslaunch = false;
  std::vector<fs::path> files;
  std::vector<std::string> given;
  for (const auto& word : words) {
    const auto assigned = word.find(":=");
    if (assigned != std::string::npos) {
      given.push_back(word.substr(0, assigned));
    } else if (fs::path(word).extension() == ".launch") {
      files.emplace_back(word);
    }
    is_roslaunch = is_roslaunch || fs::path(word).filename() == "roslaunch";
  }
  std::error_code error;
  if (!is_roslaunch || files.size() != 1) return;
  const fs::path file = folder / files[0].filename();
  const bool is_ours =
      files[0].has_parent_path() ? fs::equivalent(files[0], file, error) : fs::exists(file, error);
  if (!is_ours) return;
  const auto known = argumentsOf(file);
  for (const auto& name : given) {
    const bool is_argument = std::regex_match(name, std::regex("[A-Za-z]\\w*"));  // no __name, no /topic
    if (is_argument && std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError(file.filename().string() + " has no argument '" + name + "'" +
                       parameters::didYouMean(name, known));
  }
}

}  // namespace window_ingress::tools
