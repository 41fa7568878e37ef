#include "adapters/nodes.hpp"

using namespace window_ingress::adapters;

int main(int argc, char** argv) { return runNode(argc, argv, "world", makeWorld); }
