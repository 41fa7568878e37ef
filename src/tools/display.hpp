/// Whether there is a screen: the toolkits behind highgui end the program where there is none.
#pragma once

#include <cstdlib>

namespace window_ingress::tools {

inline bool hasDisplay() {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"})
    if (const char* value = std::getenv(name); value && *value) return true;
  return false;
}

}  // namespace window_ingress::tools
