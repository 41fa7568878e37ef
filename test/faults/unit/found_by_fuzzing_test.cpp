/// Inputs that fuzzers once found must not fail again.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "targets.hpp"

namespace window_ingress::fuzz::found_by_fuzzing_test {

namespace fs = std::filesystem;

struct Named {
  const char* name;
  Target* target;
};
const Named kTargets[] = {{"image", image},     {"detection", detection}, {"camera_info", camera_info},
                          {"corners", corners}, {"scenario", scenario},   {"parameters", parameters},
                          {"bag", bag}};

std::vector<std::uint8_t> contentOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

class FoundByFuzzing : public testing::TestWithParam<Named> {};

TEST_P(FoundByFuzzing, StaysMended) {
  const fs::path folder =
      fs::path(WINDOW_INGRESS_SOURCE_DIR) / "test" / "fuzz" / "regressions" / GetParam().name;
  if (!fs::is_directory(folder)) return;  // the fuzzers have found nothing
  for (const auto& file : fs::directory_iterator(folder)) {
    SCOPED_TRACE(file.path().string());
    const auto bytes = contentOf(file.path());
    EXPECT_NO_THROW(GetParam().target(bytes.data(), bytes.size()));
  }
}

TEST_P(FoundByFuzzing, AFewRandomInputsAreTakenAsWell) {
  std::mt19937 random(1);
  for (std::size_t size : {0u, 1u, 7u, 64u, 300u, 1000u}) {
    std::vector<std::uint8_t> bytes(size);
    for (int i = 0; i < 20; ++i) {
      for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
      EXPECT_NO_THROW(GetParam().target(bytes.data(), bytes.size()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, FoundByFuzzing, testing::ValuesIn(kTargets),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace window_ingress::fuzz::found_by_fuzzing_test
