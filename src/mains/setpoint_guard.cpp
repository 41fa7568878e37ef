#include "adapters/guard/guard_node.hpp"

int main(int argc, char** argv) {
  return window_ingress::adapters::runNode<window_ingress::adapters::GuardNode>(argc, argv, "setpoint_guard");
}
