#include "adapters/images/image_compressor.hpp"

int main(int argc, char** argv) {
  return window_ingress::adapters::runNode<window_ingress::adapters::ImageCompressorNode>(argc, argv,
                                                                                          "image_compressor");
}
