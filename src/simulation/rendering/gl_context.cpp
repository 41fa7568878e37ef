#include "simulation/rendering/gl_context.hpp"

#include <GL/osmesa.h>

#include <array>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <string>

namespace window_ingress::simulation {
namespace {

constexpr int kDummySize_px =
    16;  // images are drawn into framebuffer objects; OSMesa wants a buffer all the same

std::mutex& contextMutex() {
  static std::mutex mutex;
  return mutex;
}

// Read by Mesa when the first context of the process is made; what the user has set stands. No threads of its
// own: flights run side by side in processes or threads already.
void chooseDriver() {
  ::setenv("GALLIUM_DRIVER", "llvmpipe", 0);
  ::setenv("LP_NUM_THREADS", "0", 0);
}

template <typename Function>
void fetch(const char* name, Function& function) {
  function = reinterpret_cast<Function>(OSMesaGetProcAddress(name));
  if (!function) throw std::runtime_error(std::string("OSMesa has no ") + name);
}

}  // namespace

struct GlContext::Impl {
  OSMesaContext context = nullptr;
  std::array<unsigned char, 4 * kDummySize_px * kDummySize_px> dummy{};
  GlFunctions gl;

  ~Impl() {
    const std::lock_guard<std::mutex> lock(contextMutex());
    if (context && OSMesaGetCurrentContext() == context) OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
    if (context) OSMesaDestroyContext(context);
  }
};

GlContext::GlContext() : impl_(new Impl) {
  {
    const std::lock_guard<std::mutex> lock(contextMutex());
    chooseDriver();
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              24,
                              OSMESA_PROFILE,
                              OSMESA_COMPAT_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              0};
    impl_->context = OSMesaCreateContextAttribs(attributes, nullptr);
    if (!impl_->context) impl_->context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr);
  }
  if (!impl_->context) throw std::runtime_error("OSMesa gives no OpenGL context; is libosmesa6 installed?");
#define WINDOW_INGRESS_GL_FETCH(name, result, arguments) fetch("gl" #name, impl_->gl.name);
  WINDOW_INGRESS_GL_FUNCTIONS(WINDOW_INGRESS_GL_FETCH)
#undef WINDOW_INGRESS_GL_FETCH
  const auto* renderer = reinterpret_cast<const char*>(makeCurrent().GetString(GL_RENDERER));
  const std::string text = renderer ? renderer : "nothing";
  if (text.find("llvmpipe") == std::string::npos)
    throw std::runtime_error("OpenGL renders with \"" + text +
                             "\", far too slow; unset GALLIUM_DRIVER, or install a Mesa with llvmpipe");
}

GlContext::~GlContext() = default;

const GlFunctions& GlContext::makeCurrent() {
  if (!OSMesaMakeCurrent(impl_->context, impl_->dummy.data(), GL_UNSIGNED_BYTE, kDummySize_px, kDummySize_px))
    throw std::runtime_error("OSMesa refuses to make its context current");
  return impl_->gl;
}

}  // namespace window_ingress::simulation
