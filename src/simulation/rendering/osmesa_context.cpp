#include <GL/osmesa.h>

#include <array>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <type_traits>

#include "simulation/rendering/gl_context.hpp"

namespace window_ingress::simulation {
namespace {

std::mutex contexts;  // held while one is made or destroyed

struct DestroyOsmesa {
  void operator()(OSMesaContext context) const {
    const std::lock_guard<std::mutex> lock(contexts);
    if (OSMesaGetCurrentContext() == context) OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
    OSMesaDestroyContext(context);
  }
};

class OsmesaContext : public GlContext {
 public:
  OsmesaContext() : context_(create()) {
    if (!context_) throw std::runtime_error("OSMesa gives no OpenGL context; is libosmesa6 installed?");
    makeCurrent();
    load(OSMesaGetProcAddress);
  }

  void makeCurrent() override {
    if (!OSMesaMakeCurrent(context_.get(), dummy_.data(), GL_UNSIGNED_BYTE, kDummySize_px, kDummySize_px))
      throw std::runtime_error("OSMesa refuses to make its context current");
  }

  void release() override {}  // OSMesa accepts a context that is current elsewhere

 private:
  static OSMesaContext create() {
    const std::lock_guard<std::mutex> lock(contexts);
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
    const OSMesaContext context = OSMesaCreateContextAttribs(attributes, nullptr);
    return context ? context : OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr);
  }

  // OSMesa needs a buffer although images are drawn into framebuffer objects.
  static constexpr int kDummySize_px = 16;

  std::array<unsigned char, 4 * kDummySize_px * kDummySize_px> dummy_{};
  std::unique_ptr<std::remove_pointer_t<OSMesaContext>, DestroyOsmesa> context_;
};

}  // namespace

std::unique_ptr<GlContext> makeOsmesaContext() { return std::make_unique<OsmesaContext>(); }

}  // namespace window_ingress::simulation
