#pragma once

#include <memory>

#include "simulation/rendering/gl_functions.hpp"

namespace window_ingress::simulation {

/// An off-screen OpenGL context of OSMesa, drawn by llvmpipe in this process.
class GlContext {
 public:
  /// \throws std::runtime_error if there is no context, a function is missing, or the renderer is not
  /// llvmpipe (softpipe is ten times slower).
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// To be called in each thread and before each image: another context may have been current.
  const GlFunctions& makeCurrent();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::simulation
