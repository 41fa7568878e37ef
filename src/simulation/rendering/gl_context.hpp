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

  /// In the calling thread; another context may have been current.
  virtual void makeCurrent() = 0;
  /// Another thread may then make it current.
  virtual void release() = 0;
  const GlFunctions& functions() const { return gl_; }

 protected:
  using Function = void (*)();

  GlContext() = default;
  /// Mesa reads its environment when a process makes its first context; what the user has set stands.
  static void chooseDriver();
  /// To be called once it is current.
  /// \throws std::runtime_error if a function is missing or the renderer is not llvmpipe (softpipe is ten
  /// times slower).
  void load(Function (*find)(const char* name));

 private:
  GlFunctions gl_;
};

/// By the library that the package was configured with.
/// \throws std::runtime_error, as the others, if there is none, or none drawn by llvmpipe
std::unique_ptr<GlContext> makeGlContext();
/// By OSMesa, which Mesa has up to version 25.0. Of this one and the next the library has the one that was
/// configured.
std::unique_ptr<GlContext> makeOsmesaContext();
std::unique_ptr<GlContext> makeEglContext();  ///< by Mesa's EGL

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
