#include "adapters/world/world_node.hpp"

int main(int argc, char** argv) {
  return window_ingress::adapters::runNode<window_ingress::adapters::WorldNode>(argc, argv, "world");
}
