// A write never waits for the reader. Text written before the reader stopped still arrives complete.
#include "adapters/runtime/console_decoupling.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <string>

namespace window_ingress::adapters::console_decoupling_test {

constexpr int kMany = 20000;
const std::string kLine(99, 'x');

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// A pipe that is read by the test, or by nobody.
class ConsoleDecoupling : public testing::Test {
 protected:
  void SetUp() override {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    reader_ = ends[0];
    output_ = ends[1];
    decoupleOutput(output_);
  }
  void TearDown() override {
    if (output_ >= 0) close(output_);
    if (reader_ >= 0) close(reader_);
  }
  /// \return number of lines that were written
  int writeLines(int count) const {
    int written = 0;
    for (int i = 0; i < count; ++i) {
      const std::string line = std::to_string(i) + kLine + "\n";
      written += write(output_, line.data(), line.size()) == static_cast<ssize_t>(line.size()) ? 1 : 0;
    }
    return written;
  }
  std::string readToTheEnd() {
    close(output_);
    output_ = -1;
    std::string text;
    char chunk[4096];
    for (ssize_t size; (size = read(reader_, chunk, sizeof chunk)) > 0;)
      text.append(chunk, static_cast<std::size_t>(size));
    return text;
  }
  int reader_ = -1, output_ = -1;
};

TEST_F(ConsoleDecoupling, PassesOnWhatIsWrittenAndEnds) {
  ASSERT_EQ(writeLines(2), 2);
  EXPECT_EQ(readToTheEnd(), "0" + kLine + "\n1" + kLine + "\n");
}

TEST_F(ConsoleDecoupling, NeverWaitsForOneThatDoesNotRead) {
  const auto begin = std::chrono::steady_clock::now();
  const int written = writeLines(kMany);
  EXPECT_LT(secondsSince(begin), 2.0);
  EXPECT_GT(written, 600) << "64 KB stand in line";
  EXPECT_LT(written, kMany) << "nobody reads: the rest is lost";
  const std::string text = readToTheEnd();
  EXPECT_EQ(text.compare(0, kLine.size() + 2, "0" + kLine + "\n"), 0);
  EXPECT_EQ(text.back(), '\n') << "lines are lost whole";
}

TEST_F(ConsoleDecoupling, SurvivesThatNobodyIsThere) {
  close(reader_);
  reader_ = -1;
  EXPECT_GT(writeLines(100), 0);
}

}  // namespace window_ingress::adapters::console_decoupling_test
