#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

#include <memory>
#include <opencv2/core.hpp>
#include <stdexcept>

namespace window_ingress::simulation {

// OpenGL functions, all fetched from the library that makes the context. If they were linked by name, another
// libGL in the process (of a window toolkit) could replace them and draw nothing.
#define WINDOW_INGRESS_GL_FUNCTIONS(F)                                                              \
  F(GetString, const GLubyte*, (GLenum))                                                            \
  F(GetError, GLenum, (void))                                                                       \
  F(Enable, void, (GLenum))                                                                         \
  F(Disable, void, (GLenum))                                                                        \
  F(Fogi, void, (GLenum, GLint))                                                                    \
  F(Fogf, void, (GLenum, GLfloat))                                                                  \
  F(Fogfv, void, (GLenum, const GLfloat*))                                                          \
  F(Scissor, void, (GLint, GLint, GLsizei, GLsizei))                                                \
  F(BlendFunc, void, (GLenum, GLenum))                                                              \
  F(ColorMask, void, (GLboolean, GLboolean, GLboolean, GLboolean))                                  \
  F(ClipPlane, void, (GLenum, const GLdouble*))                                                     \
  F(FrontFace, void, (GLenum))                                                                      \
  F(DepthFunc, void, (GLenum))                                                                      \
  F(Viewport, void, (GLint, GLint, GLsizei, GLsizei))                                               \
  F(Clear, void, (GLbitfield))                                                                      \
  F(MatrixMode, void, (GLenum))                                                                     \
  F(LoadMatrixd, void, (const GLdouble*))                                                           \
  F(GenTextures, void, (GLsizei, GLuint*))                                                          \
  F(BindTexture, void, (GLenum, GLuint))                                                            \
  F(TexImage2D, void, (GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void*)) \
  F(TexParameteri, void, (GLenum, GLenum, GLint))                                                   \
  F(PixelStorei, void, (GLenum, GLint))                                                             \
  F(ReadPixels, void, (GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*))                      \
  F(EnableClientState, void, (GLenum))                                                              \
  F(VertexPointer, void, (GLint, GLenum, GLsizei, const void*))                                     \
  F(TexCoordPointer, void, (GLint, GLenum, GLsizei, const void*))                                   \
  F(ColorPointer, void, (GLint, GLenum, GLsizei, const void*))                                      \
  F(DrawElements, void, (GLenum, GLsizei, GLenum, const void*))                                     \
  F(GenBuffers, void, (GLsizei, GLuint*))                                                           \
  F(BindBuffer, void, (GLenum, GLuint))                                                             \
  F(BufferData, void, (GLenum, GLsizeiptr, const void*, GLenum))                                    \
  F(GenerateMipmap, void, (GLenum))                                                                 \
  F(GenFramebuffers, void, (GLsizei, GLuint*))                                                      \
  F(BindFramebuffer, void, (GLenum, GLuint))                                                        \
  F(CheckFramebufferStatus, GLenum, (GLenum))                                                       \
  F(FramebufferTexture2D, void, (GLenum, GLenum, GLenum, GLuint, GLint))                            \
  F(FramebufferRenderbuffer, void, (GLenum, GLenum, GLenum, GLuint))                                \
  F(GenRenderbuffers, void, (GLsizei, GLuint*))                                                     \
  F(BindRenderbuffer, void, (GLenum, GLuint))                                                       \
  F(RenderbufferStorage, void, (GLenum, GLenum, GLsizei, GLsizei))                                  \
  F(RenderbufferStorageMultisample, void, (GLenum, GLsizei, GLenum, GLsizei, GLsizei))              \
  F(BlitFramebuffer, void, (GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLbitfield, GLenum))

struct GlFunctions {
#define WINDOW_INGRESS_GL_MEMBER(name, result, arguments) result(*name) arguments = nullptr;
  WINDOW_INGRESS_GL_FUNCTIONS(WINDOW_INGRESS_GL_MEMBER)
#undef WINDOW_INGRESS_GL_MEMBER
};

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

/// Target of the drawing: an image and its depths, with one or several samples per pixel.
class GlTarget {
 public:
  /// \throws std::runtime_error if OpenGL refuses
  void create(const GlFunctions& gl, const cv::Size& size, int samples) {
    size_ = size;
    gl.GenFramebuffers(1, &drawn_);
    gl.BindFramebuffer(GL_FRAMEBUFFER, drawn_);
    attach(gl, GL_COLOR_ATTACHMENT0, GL_RGBA8, samples);
    attach(gl, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, samples);
    bool complete = gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    if (samples > 0) {
      gl.GenFramebuffers(1, &averaged_);
      gl.BindFramebuffer(GL_FRAMEBUFFER, averaged_);
      attach(gl, GL_COLOR_ATTACHMENT0, GL_RGBA8, 0);
      complete = complete && gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    }
    if (!complete) throw std::runtime_error("OpenGL refuses a framebuffer of the image's size");
  }

  void bind(const GlFunctions& gl) const { gl.BindFramebuffer(GL_FRAMEBUFFER, drawn_); }
  /// Reads the rows `rows` into those of `rgba` (CV_8UC4); averages several samples.
  void read(const GlFunctions& gl, const cv::Range& rows, cv::Mat& rgba) const {
    gl.Disable(GL_SCISSOR_TEST);
    if (averaged_) {
      gl.BindFramebuffer(GL_READ_FRAMEBUFFER, drawn_);
      gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, averaged_);
      gl.BlitFramebuffer(0, rows.start, size_.width, rows.end, 0, rows.start, size_.width, rows.end,
                         GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, averaged_ ? averaged_ : drawn_);
    gl.ReadPixels(0, rows.start, size_.width, rows.size(), GL_RGBA, GL_UNSIGNED_BYTE, rgba.ptr(rows.start));
  }

 private:
  void attach(const GlFunctions& gl, GLenum attachment, GLenum format, int samples) const {
    GLuint buffer = 0;
    gl.GenRenderbuffers(1, &buffer);
    gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, size_.width, size_.height);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  }

  cv::Size size_;
  GLuint drawn_ = 0, averaged_ = 0;
};

}  // namespace window_ingress::simulation
