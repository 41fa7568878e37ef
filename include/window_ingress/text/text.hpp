/// Text for people: messages, tables, files.
#pragma once

#include <string>

namespace window_ingress {

/// What printf would write.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* pattern, ...);

/// The text with each number, its sign included, as one #: what remains the same while the same thing is the
/// matter.
std::string withoutNumbers(const std::string& text);

}  // namespace window_ingress
