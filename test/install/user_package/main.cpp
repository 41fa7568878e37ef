// Uses headers, library and message of the installed package from outside.
#include <window_ingress/WindowPose.h>

#include <cstdio>

#include "window_ingress/geometry/quadrilateral.hpp"

int main() {
  window_ingress::WindowPose message;
  const window_ingress::geometry::Quadrilateral square = {{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
  const double area = window_ingress::geometry::signedArea(square);
  std::printf("area %.0f px^2, reject %d\n", area, message.image.reject);
  return area == 4.0 || area == -4.0 ? 0 : 1;
}
