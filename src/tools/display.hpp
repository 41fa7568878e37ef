/// Whether there is a screen: without one, the toolkits behind highgui end the program.
#pragma once

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <string>

namespace window_ingress::tools {

/// Whether a server listens on the socket of a display of this machine, ":7" or ":7.0".
inline bool listensLocally(const std::string& display) {
  const std::string path = "/tmp/.X11-unix/X" + display.substr(1, display.find('.') - 1);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof(address.sun_path)) return false;
  std::memcpy(address.sun_path, path.c_str(), path.size());
  const int handle = socket(AF_UNIX, SOCK_STREAM, 0);
  const bool there = connect(handle, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  close(handle);
  return there;
}

/// A display of another machine is assumed to exist.
inline bool hasDisplay() {
  if (const char* wayland = std::getenv("WAYLAND_DISPLAY"); wayland && *wayland) return true;
  const char* display = std::getenv("DISPLAY");
  if (!display || !*display) return false;
  return *display != ':' || listensLocally(display);
}

}  // namespace window_ingress::tools
