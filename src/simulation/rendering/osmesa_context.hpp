#pragma once

#include <GL/osmesa.h>

#include <array>

#include "simulation/rendering/gl_context.hpp"

namespace window_ingress::simulation {

/// By OSMesa, which Mesa has up to version 25.0.
class OsmesaContext : public GlContext {
 public:
  /// \throws std::runtime_error if there is none, or none drawn by llvmpipe
  OsmesaContext();
  ~OsmesaContext() override;

  void makeCurrent() override;
  void release() override {}  // OSMesa takes a context that is current elsewhere

 private:
  // Images are drawn into framebuffer objects; OSMesa wants a buffer all the same.
  static constexpr int kDummySize_px = 16;

  OSMesaContext context_ = nullptr;
  std::array<unsigned char, 4 * kDummySize_px * kDummySize_px> dummy_{};
};

}  // namespace window_ingress::simulation
