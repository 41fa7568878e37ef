#include "adapters/images/detector_node.hpp"

int main(int argc, char** argv) {
  return window_ingress::adapters::runNode<window_ingress::adapters::DetectorNode>(argc, argv,
                                                                                   "window_detector");
}
