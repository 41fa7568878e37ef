#pragma once

#include <string>

namespace window_ingress::parameters {

/// What to say behind "unknown key" of one that earlier versions read; empty for all others.
std::string whatBecameOf(const std::string& path);

}  // namespace window_ingress::parameters
