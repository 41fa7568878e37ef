#include "adapters/bags/replay_facts.hpp"

#include <rosbag/view.h>

#include <nlohmann/json.hpp>

#include "adapters/bags/replay_tables.hpp"

namespace window_ingress::adapters {
namespace {

using Json = nlohmann::ordered_json;

std::string useOf(const std::string& topic, const BagTopics& topics) {
  if (topic == topics.image) return "image";
  if (topic == topics.camera_info) return "camera-info";
  if (topic == topics.odom) return "odom";
  if (topic == topics.imu) return "imu";
  if (topic == topics.truth) return "truth";
  return topic == "/tf_static" ? "camera mounting" : "";
}

Json topicsOf(const rosbag::Bag& bag, const BagTopics& used) {
  std::map<std::string, std::string> types;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections())
    types[connection->topic] = connection->datatype;
  Json topics = Json::array();
  for (const auto& [topic, type] : types)
    topics.push_back({{"topic", topic},
                      {"type", type},
                      {"messages", messagesIn(bag, topic)},
                      {"used_as", useOf(topic, used)}});
  return topics;
}

Json countsOf(const ReplaySummary& summary) {
  return {{"images", summary.images},
          {"without_calibration", summary.images - summary.calibrated},
          {"without_odometry", summary.images - summary.with_odometry},
          {"without_attitude", summary.images - summary.with_attitude},
          {"jumps_back_in_time", summary.jumps},
          {"messages_refused", summary.refused},
          {"refused_because", summary.reasons}};
}

std::string shellQuoted(const std::string& argument) {
  constexpr const char* kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=./,:@%";
  if (!argument.empty() && argument.find_first_not_of(kPlain) == std::string::npos) return argument;
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

}  // namespace

std::size_t messagesIn(const rosbag::Bag& bag, const std::string& topic) {
  return rosbag::View(bag, rosbag::TopicQuery(topic)).size();
}

void writeFacts(const std::filesystem::path& folder, const std::string& command, const rosbag::Bag& bag,
                const ReplayParams& params, const ReplaySummary& summary) {
  rosbag::View all(bag);
  Json facts;
  facts["command"] = command;
  facts["bag"] = {{"file", bag.getFileName()},
                  {"bytes", bag.getSize()},
                  {"begin", exactText(all.getBeginTime())},
                  {"seconds", (all.getEndTime() - all.getBeginTime()).toSec()}};
  facts["topics"] = topicsOf(bag, params.topics);
  if (params.with_pose)
    facts["window_size_m"] = {params.homography_pose.pose.opening_width_m,
                              params.homography_pose.pose.opening_height_m};
  facts["has_reference"] = params.reference.has_value();
  facts["counts"] = countsOf(summary);
  evaluation::OutputFile file(folder / "replay.json");
  file << facts.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
  file.finish();
}

std::string commandLine(int argc, char** argv) {
  std::string text = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "";
  for (int i = 1; i < argc; ++i) text += " " + shellQuoted(argv[i]);
  return text;
}

}  // namespace window_ingress::adapters
