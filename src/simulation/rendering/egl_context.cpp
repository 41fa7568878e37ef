#include "simulation/rendering/gl_context.hpp"
#include "window_ingress/text/text.hpp"

#define EGL_NO_X11  // otherwise some systems' headers include X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace window_ingress::simulation {
namespace {

[[noreturn]] void fail(const std::string& what) {
  const std::string code = formatted("0x%x", static_cast<unsigned>(eglGetError()));
  throw std::runtime_error("EGL " + what + " (" + code +
                           "); are libegl-mesa0 and libgl1-mesa-dri installed?");
}

EGLDisplay initialised() {
  const EGLDisplay display =
      eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
    fail("does not start without a display");
  return display;
}

// One display per process. It is never terminated, because other threads may have contexts on it.
EGLDisplay theDisplay() {
  static const EGLDisplay display = initialised();
  return display;
}

struct DestroyEgl {
  void operator()(EGLContext context) const { eglDestroyContext(theDisplay(), context); }
};

// A context without surface: needs neither a display nor a graphics card.
class EglContext : public GlContext {
 public:
  EglContext() {
    chooseDriver();
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};  // with the older functions
    const EGLDisplay display = theDisplay();
    if (eglBindAPI(EGL_OPENGL_API))
      context_.reset(eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes));
    if (!context_) fail("gives no OpenGL context");
    const CurrentContext current(*this);
    load(eglGetProcAddress);
  }

  void makeCurrent() override {
    if (!eglMakeCurrent(theDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, context_.get()))
      fail("refuses to make its context current");
  }

  void release() override { eglMakeCurrent(theDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

 private:
  std::unique_ptr<void, DestroyEgl> context_;  // an EGLContext is a void*
};

}  // namespace

std::unique_ptr<GlContext> makeEglContext() { return std::make_unique<EglContext>(); }

}  // namespace window_ingress::simulation
