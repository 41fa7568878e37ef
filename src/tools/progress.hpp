/// A line on stderr now and then, so that nobody thinks that a tool hangs.
#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>
#include <utility>

namespace window_ingress::tools {

class Progress {
 public:
  /// \param what is counted: "images"
  Progress(std::string tool, std::string what, std::size_t total)
      : tool_(std::move(tool)), what_(std::move(what)), total_(total) {}

  void passed() {
    ++done_;
    const auto now = std::chrono::steady_clock::now();
    if (now - said_ < std::chrono::seconds(2)) return;
    said_ = now;
    const double left_sec =
        std::chrono::duration<double>(now - began_).count() * (double(total_) / double(done_) - 1.0);
    std::cerr << tool_ << ": " << done_ << " of " << total_ << " " << what_ << ", " << std::lround(left_sec)
              << " s left" << std::endl;
  }

 private:
  std::string tool_, what_;
  std::size_t total_, done_ = 0;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point said_ = began_;
};

}  // namespace window_ingress::tools
