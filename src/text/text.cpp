#include "window_ingress/text/text.hpp"

#include <algorithm>
#include <cctype>
#include <cstdarg>
#include <cstdio>

namespace window_ingress {
namespace {

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::string formatted(const char* pattern, ...) {
  va_list values, again;
  va_start(values, pattern);
  va_copy(again, values);
  std::string text(static_cast<std::size_t>(std::max(0, std::vsnprintf(nullptr, 0, pattern, values))), '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  va_end(values);
  return text;
}

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

}  // namespace window_ingress
