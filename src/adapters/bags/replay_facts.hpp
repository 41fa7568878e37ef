/// What a replay was made from and how much of it could be used, as json for a page to show.
#pragma once

#include <rosbag/bag.h>

#include <filesystem>
#include <string>

#include "adapters/bags/replay.hpp"

namespace window_ingress::adapters {

/// How many messages of a topic lie in the bag.
std::size_t messagesIn(const rosbag::Bag& bag, const std::string& topic);

/// Writes folder/replay.json: the command, the bag with its topics and which of them were used, images with
/// and without calibration, odometry and attitude, messages refused and why.
/// \throws std::runtime_error if it cannot be written
void writeFacts(const std::filesystem::path& folder, const std::string& command, const rosbag::Bag& bag,
                const ReplayParams& params, const ReplaySummary& summary);

/// The arguments as one line that a shell takes apart again.
std::string commandLine(int argc, char** argv);

}  // namespace window_ingress::adapters
