// One program for each target, compiled with FUZZ_TARGET.
#include "targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  window_ingress::fuzz::FUZZ_TARGET(data, size);
  return 0;
}
