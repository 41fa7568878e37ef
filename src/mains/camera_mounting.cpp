#include "adapters/pose/camera_mounting.hpp"

int main(int argc, char** argv) {
  return window_ingress::adapters::runNode<window_ingress::adapters::CameraMountingNode>(argc, argv,
                                                                                         "camera_mounting");
}
