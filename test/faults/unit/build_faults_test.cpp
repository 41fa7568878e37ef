/// M95: a build whose compiler flags assume that NaN is impossible.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace {

struct Compiled {
  bool succeeded;
  std::string output;
};

Compiled compile(const std::string& header, const std::string& flags) {
  const std::string command = "echo '#include \"window_ingress/" + header +
                              "\"' | " WINDOW_INGRESS_COMPILER
                              " -x c++ -std=c++17 -E -o /dev/null -I" WINDOW_INGRESS_SOURCE_DIR
                              "/include -isystem " WINDOW_INGRESS_EIGEN " " +
                              flags + " - 2>&1";
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (!pipe) return {false, "popen failed"};
  std::string output;
  std::array<char, 4096> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe)) output += buffer.data();
  return {pclose(pipe) == 0, output};
}

TEST(Fault, M95_FastMathDoesNotCompile) {
  const volatile double zero = 0.0;  // prevents constant folding
  EXPECT_FALSE(std::isfinite(zero / zero) || std::isfinite(1.0 / zero)) << "this build itself";
  for (const std::string header : {"geometry/frames.hpp", "geometry/pinhole_camera.hpp"}) {
    const Compiled plain = compile(header, "-O2");
    EXPECT_TRUE(plain.succeeded) << plain.output;
    for (const std::string flags : {"-ffast-math", "-ffinite-math-only", "-Ofast"}) {
      const Compiled fast = compile(header, flags);
      EXPECT_FALSE(fast.succeeded) << header << " " << flags;
      EXPECT_NE(fast.output.find("isfinite(NaN) would be true"), std::string::npos) << fast.output;
    }
  }
  RecordProperty("seen",
                 "-ffast-math, -ffinite-math-only, -Ofast: the build ends with an #error; isfinite told "
                 "right in this one");
}

}  // namespace
