#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "window_ingress/text/text.hpp"

namespace window_ingress::test {

/// Succeeds if the text contains these words; otherwise shows both.
inline testing::AssertionResult says(const std::string& text, const std::string& words) {
  if (text.find(words) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << words << "' is not said by: " << text;
}

/// The message of the Error that `action` throws; empty if it throws none.
template <typename Error = InputError, typename Action>
std::string refusalOf(const Action& action) {
  try {
    action();
  } catch (const Error& refused) {
    return refused.what();
  }
  return "";
}

/// A unique folder that is deleted with its object.
struct TemporaryFolder {
  TemporaryFolder() : path(mkdtemp(std::string("/tmp/window_ingress_XXXXXX").data())) {}
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// Writes the text into the file. \return its absolute path
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
    return (path / name).string();
  }
  std::filesystem::path path;
};

}  // namespace window_ingress::test
