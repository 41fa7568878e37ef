/// Text for people: messages, tables, files.
#pragma once

#include <stdexcept>
#include <string>

namespace window_ingress {

/// An option, a parameter or a file of the user cannot be used. `what()` has one line per fault: what is
/// wrong, where, and what to do. Tools and nodes end with exit code 2.
class InputError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Answer to a request: never silent.
struct Reply {
  bool success = false;
  std::string message;
};

/// Formats a text as printf does.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* pattern, ...);

/// The text with each number, sign included, replaced by #: texts with the same cause become equal.
std::string withoutNumbers(const std::string& text);

}  // namespace window_ingress
