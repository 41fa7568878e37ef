#pragma once

#include <string>

namespace window_ingress::adapters {

/// What is wrong with the structure of a bag, so that rosbag must not open it: it follows lengths and places
/// out of the file without asking, and reads past its buffers. Empty if it may, or if rosbag itself will say
/// what is the matter (no file, no bag, no index). Of compressed chunks, whose contents bear a checksum, only
/// the sizes are looked at.
std::string whyDamaged(const std::string& file);

}  // namespace window_ingress::adapters
