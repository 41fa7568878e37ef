/// Whether a launch would take nodes away from one that runs: ROS ends a node when another of its name
/// starts.
#pragma once

#include <xmlrpcpp/XmlRpc.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <string>
#include <vector>

#include "command_line.hpp"

namespace window_ingress::tools {

/// The answer of a ROS master or node to one question; invalid if nobody is there.
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

/// The master that roslaunch, called with these words, will use.
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

/// \param words of roslaunch \throws InputError that names the first of these nodes that runs already
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

}  // namespace window_ingress::tools
