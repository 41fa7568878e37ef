#pragma once

#include "simulation/rendering/gl_context.hpp"

namespace window_ingress::simulation {

/// By Mesa's EGL without any surface: it needs neither a display nor a graphics card.
class EglContext : public GlContext {
 public:
  /// \throws std::runtime_error if there is none, or none drawn by llvmpipe
  EglContext();
  ~EglContext() override;

  void makeCurrent() override;
  void release() override;

 private:
  void* context_;  // an EGLContext; on some systems EGL's headers bring the macros of X11
};

}  // namespace window_ingress::simulation
