#include "adapters/navigator/navigator_node.hpp"

int main(int argc, char** argv) {
  return window_ingress::adapters::runNode<window_ingress::adapters::NavigatorNode>(argc, argv,
                                                                                    "ingress_navigator");
}
