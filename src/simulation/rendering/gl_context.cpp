#include "simulation/rendering/gl_context.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace window_ingress::simulation {

// No threads of Mesa's own, because flights already run in parallel processes or threads.
void GlContext::chooseDriver() {
  ::setenv("LIBGL_ALWAYS_SOFTWARE", "true", 0);  // else EGL takes a graphics card; OSMesa never does
  ::setenv("GALLIUM_DRIVER", "llvmpipe", 0);
  ::setenv("LP_NUM_THREADS", "0", 0);
}

void GlContext::load(Function (*find)(const char* name)) {
  const auto fetch = [find](const char* name, auto& function) {
    function = reinterpret_cast<std::decay_t<decltype(function)>>(find(name));
    if (!function) throw std::runtime_error(std::string("OpenGL has no ") + name);
  };
#define WINDOW_INGRESS_GL_FETCH(name, result, arguments) fetch("gl" #name, gl_.name);
  WINDOW_INGRESS_GL_FUNCTIONS(WINDOW_INGRESS_GL_FETCH)
#undef WINDOW_INGRESS_GL_FETCH
  const auto* renderer = reinterpret_cast<const char*>(gl_.GetString(GL_RENDERER));
  const std::string text = renderer ? renderer : "nothing";
  if (text.find("llvmpipe") == std::string::npos)
    throw std::runtime_error("OpenGL renders with \"" + text +
                             "\", not with llvmpipe; unset GALLIUM_DRIVER and LIBGL_ALWAYS_SOFTWARE, or "
                             "install a Mesa with llvmpipe");
}

std::unique_ptr<GlContext> makeGlContext() {
#ifdef WINDOW_INGRESS_OFFSCREEN_EGL
  return makeEglContext();
#else
  return makeOsmesaContext();
#endif
}

}  // namespace window_ingress::simulation
