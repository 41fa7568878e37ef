#include "window_ingress/parameters/text.hpp"

#include <cctype>

namespace window_ingress::parameters {
namespace {

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::string withoutNumbers(const std::string& text) {
  std::string kept;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool in_number = !kept.empty() && kept.back() == '#';
    const bool is_sign = (c == '-' || c == '+') && i + 1 < text.size() && isDigit(text[i + 1]) &&
                         (kept.empty() || kept.back() == ' ');
    if (is_sign || (in_number && (isDigit(c) || c == '.'))) continue;
    kept += isDigit(c) ? '#' : c;
  }
  return kept;
}

}  // namespace window_ingress::parameters
