#pragma once

#include <memory>

#include "simulation/rendering/gl_functions.hpp"

namespace window_ingress::simulation {

/// An off-screen OpenGL context, drawn by llvmpipe in this process.
class GlContext {
 public:
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Makes the context current in the calling thread, in place of any other one.
  virtual void makeCurrent() = 0;
  /// Lets another thread make the context current.
  virtual void release() = 0;
  const GlFunctions& functions() const { return gl_; }

 protected:
  using Function = void (*)();

  GlContext() = default;
  /// Sets the environment that Mesa reads at a process's first context; keeps the user's own settings.
  static void chooseDriver();
  /// Call once the context is current.
  /// \throws std::runtime_error if a function is missing or the renderer is not llvmpipe (softpipe is ten
  /// times slower).
  void load(Function (*find)(const char* name));

 private:
  GlFunctions gl_;
};

/// A context of the library that the package was configured with.
/// \throws std::runtime_error, as the others, if there is none, or if its renderer is not llvmpipe
std::unique_ptr<GlContext> makeGlContext();
/// A context of OSMesa, which Mesa has up to version 25.0. The library contains only the configured one of
/// this and the next function.
std::unique_ptr<GlContext> makeOsmesaContext();
std::unique_ptr<GlContext> makeEglContext();  ///< a context of Mesa's EGL

/// Keeps a context current in this thread.
class CurrentContext {
 public:
  explicit CurrentContext(GlContext& context) : context_(context) { context_.makeCurrent(); }
  ~CurrentContext() { context_.release(); }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

  const GlFunctions& gl() const { return context_.functions(); }

 private:
  GlContext& context_;
};

}  // namespace window_ingress::simulation
