#include <GL/osmesa.h>

#include <array>
#include <mutex>
#include <stdexcept>

#include "simulation/rendering/gl_context.hpp"

namespace window_ingress::simulation {
namespace {

std::mutex& contextMutex() {
  static std::mutex mutex;
  return mutex;
}

OSMesaContext create() {
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            24,
                            OSMESA_PROFILE,
                            OSMESA_COMPAT_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            0};
  const OSMesaContext context = OSMesaCreateContextAttribs(attributes, nullptr);
  return context ? context : OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr);
}

void destroy(OSMesaContext context) {
  const std::lock_guard<std::mutex> lock(contextMutex());
  if (OSMesaGetCurrentContext() == context) OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
  OSMesaDestroyContext(context);
}

class OsmesaContext : public GlContext {
 public:
  OsmesaContext() {
    {
      const std::lock_guard<std::mutex> lock(contextMutex());
      chooseDriver();
      context_ = create();
    }
    if (!context_) throw std::runtime_error("OSMesa gives no OpenGL context; is libosmesa6 installed?");
    try {
      makeCurrent();
      load(OSMesaGetProcAddress);
    } catch (...) {
      destroy(context_);
      throw;
    }
  }

  ~OsmesaContext() override { destroy(context_); }

  void makeCurrent() override {
    if (!OSMesaMakeCurrent(context_, dummy_.data(), GL_UNSIGNED_BYTE, kDummySize_px, kDummySize_px))
      throw std::runtime_error("OSMesa refuses to make its context current");
  }

  void release() override {}  // OSMesa accepts a context that is current elsewhere

 private:
  // OSMesa needs a buffer although images are drawn into framebuffer objects.
  static constexpr int kDummySize_px = 16;

  OSMesaContext context_ = nullptr;
  std::array<unsigned char, 4 * kDummySize_px * kDummySize_px> dummy_{};
};

}  // namespace

std::unique_ptr<GlContext> makeOsmesaContext() { return std::make_unique<OsmesaContext>(); }

}  // namespace window_ingress::simulation
