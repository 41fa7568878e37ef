/// Where recorded data for tests lies; it is not part of the repository.
#pragma once

#include <filesystem>
#include <string>

namespace window_ingress::test {

/// Path of a file of the shared data, whether or not it exists.
inline std::filesystem::path sharedData(const std::string& relative) {
  return std::filesystem::path(WINDOW_INGRESS_SOURCE_DIR) / ".." / "shared" / "data" / relative;
}

}  // namespace window_ingress::test

/// Skips the test, saying so, where the shared data is absent.
#define WINDOW_INGRESS_NEEDS_DATA(relative)                                               \
  do {                                                                                    \
    if (!std::filesystem::exists(window_ingress::test::sharedData(relative)))             \
      GTEST_SKIP() << "no " << window_ingress::test::sharedData(relative) << ": skipped"; \
  } while (false)
