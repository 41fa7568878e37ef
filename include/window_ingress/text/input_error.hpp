#pragma once

#include <stdexcept>

namespace window_ingress {

/// What somebody gave cannot be used: an option, a parameter, a file. `what()` has a line for each fault,
/// which says what is wrong, where, and what to do. Tools and nodes end with exit code 2.
class InputError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace window_ingress
