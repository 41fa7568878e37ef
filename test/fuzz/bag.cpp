#include "adapters/bags/replay.hpp"
#include "memory_file.hpp"
#include "targets.hpp"

namespace window_ingress::fuzz {

void bag(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  try {
    rosbag::Bag recorded;
    adapters::openBag(recorded, file.name());
    adapters::ReplayParams params;
    params.topics = adapters::chooseTopics(recorded, {});
    params.window_detector.image.max_pixels = 1 << 14;
    params.with_pose = true;
    int frames = 0;
    adapters::replay(recorded, params, [&](const adapters::ReplayedFrame& frame) {
      require(!frame.image.empty(), "a frame has an image");
      ++frames;
    });
  } catch (const InputError& error) {
    require(std::string(error.what()).find(file.name()) == 0, "a refusal names the file");
  }
}

}  // namespace window_ingress::fuzz
