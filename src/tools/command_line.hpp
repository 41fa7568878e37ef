/// What the command-line tools share: their errors, and options that need more than boost's parser.
#pragma once

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace window_ingress::tools {

/// Wrong usage or input that cannot be used: one line, exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `count` finite numbers with commas between. \throws UsageError that names the option
inline std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t count) {
  std::vector<double> values;
  bool good = true;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    char* end = nullptr;
    values.push_back(std::strtod(part.c_str(), &end));
    good = good && !part.empty() && *end == '\0' && std::isfinite(values.back());
  }
  if (!good || values.size() != count)
    throw UsageError(option + ": '" + text + "' is not " + std::to_string(count) +
                     " numbers with commas between");
  return values;
}

/// Makes the folder if it is missing. \throws UsageError
inline void makeFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) throw UsageError(folder + ": cannot make this folder");
}

}  // namespace window_ingress::tools
