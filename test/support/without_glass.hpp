/// For tests without an operator.
#pragma once

#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::test {

/// The defaults, but with glass excluded: the vehicle flies through an open window without asking.
inline navigation::NavigatorParams withoutGlass() {
  navigation::NavigatorParams params;
  params.commit.glass = "excluded";
  return params;
}

}  // namespace window_ingress::test
