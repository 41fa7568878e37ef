/// OpenGL functions, all fetched from the library that makes the context. If they were linked by name,
/// another libGL in the process (of a window toolkit) could replace them and draw nothing.
#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

namespace window_ingress::simulation {

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

}  // namespace window_ingress::simulation
