#include "window_ingress/parameters/fields.hpp"

#include <algorithm>

namespace window_ingress::parameters {

void RangeCheck::choice(const std::string& name, const std::string& value,
                        const std::vector<std::string>& allowed) {
  if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return;
  std::string words;
  for (const auto& word : allowed) words += (words.empty() ? "" : ", ") + word;
  faults_.push_back(prefix_ + name + " = " + value + " is none of " + words);
}

std::string joined(const std::vector<std::string>& texts, const char* between) {
  std::string line;
  for (const auto& text : texts) line += (line.empty() ? "" : between) + text;
  return line;
}

}  // namespace window_ingress::parameters
