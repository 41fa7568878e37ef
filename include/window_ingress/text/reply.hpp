#pragma once

#include <string>

namespace window_ingress {

/// Answer to a request: never silent.
struct Reply {
  bool success = false;
  std::string message;
};

}  // namespace window_ingress
