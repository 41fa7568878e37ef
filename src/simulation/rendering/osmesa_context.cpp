#include "simulation/rendering/osmesa_context.hpp"

#include <mutex>
#include <stdexcept>

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

}  // namespace

OsmesaContext::OsmesaContext() {
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

OsmesaContext::~OsmesaContext() { destroy(context_); }

void OsmesaContext::makeCurrent() {
  if (!OSMesaMakeCurrent(context_, dummy_.data(), GL_UNSIGNED_BYTE, kDummySize_px, kDummySize_px))
    throw std::runtime_error("OSMesa refuses to make its context current");
}

}  // namespace window_ingress::simulation
