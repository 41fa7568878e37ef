#pragma once

#include <string>

namespace window_ingress::adapters {

/// Why rosbag must not open this bag: rosbag follows damaged lengths and places out of the file, and reads
/// past its buffers. Empty if rosbag may open it, or reports the fault itself (no file, no bag, no index).
/// Compressed chunks have a checksum; only their sizes are checked.
std::string whyDamaged(const std::string& file);

}  // namespace window_ingress::adapters
