/// Text for people: messages, tables, files.
#pragma once

#include <stdexcept>
#include <string>

namespace window_ingress {

/// What somebody gave cannot be used: an option, a parameter, a file. `what()` has a line for each fault,
/// which says what is wrong, where, and what to do. Tools and nodes end with exit code 2.
class InputError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// What printf would write.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* pattern, ...);

/// The text with each number, its sign included, as one #: what remains the same while the same thing is the
/// matter.
std::string withoutNumbers(const std::string& text);

}  // namespace window_ingress
