#include "simulation/scenario/scenario.hpp"

#include "memory_file.hpp"
#include "targets.hpp"

namespace window_ingress::fuzz {

void scenario(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  for (const std::uint32_t seed : {1u, 2u}) {
    try {
      const simulation::Scenario loaded = simulation::loadScenario(file.name(), seed);
      require(simulation::faultsOf(loaded).empty(), "an accepted scenario has no fault");
    } catch (const InputError& error) {
      require(std::string(error.what()).find(file.name()) == 0, "a refusal names the file");
    }
  }
}

}  // namespace window_ingress::fuzz
