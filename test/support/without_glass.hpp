/// For tests in which nobody is there to be asked.
#pragma once

#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::test {

/// The defaults, but somebody has made sure that there is no glass: an open window is flown through unasked.
inline navigation::NavigatorParams withoutGlass() {
  navigation::NavigatorParams params;
  params.commit.glass = "excluded";
  return params;
}

}  // namespace window_ingress::test
