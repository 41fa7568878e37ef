#include "adapters/pose/pose_node.hpp"

int main(int argc, char** argv) {
  return window_ingress::adapters::runNode<window_ingress::adapters::PoseNode>(argc, argv, "homography_pose");
}
