#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::parameters {

std::string joined(const std::vector<std::string>& texts) {
  std::string line;
  for (const auto& text : texts) line += (line.empty() ? "" : "; ") + text;
  return line;
}

}  // namespace window_ingress::parameters
