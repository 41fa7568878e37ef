#pragma once

#include <string>

namespace window_ingress::parameters {

/// The text with each number, its sign included, as one #: what remains the same while the same thing is the
/// matter.
std::string withoutNumbers(const std::string& text);

}  // namespace window_ingress::parameters
