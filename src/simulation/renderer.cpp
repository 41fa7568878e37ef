#include "window_ingress/simulation/renderer.hpp"

#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "gl_context.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::simulation {
namespace {

constexpr int kSamples = 4;
constexpr double kNear_m = 0.03;
constexpr double kFar_m = 1000.0;

// From the optical frame to clip coordinates. Row 0 of the picture is OpenGL's lowest, so that no row needs
// to be moved after reading; pixel u has its centre at u + 0.5 in OpenGL's window.
Eigen::Matrix4d projectionOf(const geometry::PinholeCamera& camera) {
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = 2.0 * camera.fx / camera.width;
  clip(0, 2) = 2.0 * (camera.cx + 0.5) / camera.width - 1.0;
  clip(1, 1) = 2.0 * camera.fy / camera.height;
  clip(1, 2) = 2.0 * (camera.cy + 0.5) / camera.height - 1.0;
  clip(2, 2) = (kFar_m + kNear_m) / (kFar_m - kNear_m);
  clip(2, 3) = -2.0 * kFar_m * kNear_m / (kFar_m - kNear_m);
  clip(3, 2) = 1.0;
  return clip;
}

// Blending two levels costs as much as all the rest; only regular patterns show where levels meet.
GLint minifyingFilter(Texture texture) {
  const bool regular =
      texture == Texture::kBrick || texture == Texture::kTiles || texture == Texture::kPaving;
  return regular ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_NEAREST;
}

void requireUsable(const geometry::PinholeCamera& camera) {
  const auto faults = camera.validate();
  if (!faults.empty()) throw std::invalid_argument("Renderer: " + parameters::joined(faults));
  if (camera.hasDistortion()) throw std::invalid_argument("Renderer: draws without distortion only");
}

}  // namespace

struct Renderer::Impl {
  struct Batch {
    bool indoors, textured;
    GLuint texture;
    GLint first;
    GLsizei count;
  };

  Impl(const Scene& scene, const geometry::PinholeCamera& ideal) : camera(ideal), opening(scene.opening) {
    const GlFunctions& gl = context.makeCurrent();
    makeFramebuffers(gl);
    upload(gl, scene);
    setState(gl);
    bgra.create(camera.height, camera.width, CV_8UC4);
    if (gl.GetError() != GL_NO_ERROR)
      throw std::runtime_error("OpenGL reports an error while loading the scene");
  }

  GLuint attach(const GlFunctions& gl, GLenum attachment, GLenum format, int samples) const {
    GLuint buffer = 0;
    gl.GenRenderbuffers(1, &buffer);
    gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, camera.width, camera.height);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
    return buffer;
  }

  void makeFramebuffers(const GlFunctions& gl) {
    gl.GenFramebuffers(1, &sampled);
    gl.BindFramebuffer(GL_FRAMEBUFFER, sampled);
    attach(gl, GL_COLOR_ATTACHMENT0, GL_RGBA8, kSamples);
    attach(gl, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, kSamples);
    const bool sampled_ok = gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    gl.GenFramebuffers(1, &resolved);
    gl.BindFramebuffer(GL_FRAMEBUFFER, resolved);
    attach(gl, GL_COLOR_ATTACHMENT0, GL_RGBA8, 0);
    const bool resolved_ok = gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    if (!sampled_ok || !resolved_ok)
      throw std::runtime_error("OpenGL refuses a framebuffer with 4 samples a pixel");
  }

  static GLuint uploadTexture(const GlFunctions& gl, Texture kind, std::uint32_t seed) {
    const cv::Mat image = makeTexture(kind, seed);
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.cols, image.rows, 0, GL_RGB, GL_UNSIGNED_BYTE,
                  image.data);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minifyingFilter(kind));
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.GenerateMipmap(GL_TEXTURE_2D);
    return texture;
  }

  void upload(const GlFunctions& gl, const Scene& scene) {
    std::vector<Vertex> vertices;
    for (const auto& [batch, quads] : scene.mesh.batches()) {
      batches.push_back({batch.indoors, batch.texture != Texture::kPlain,
                         uploadTexture(gl, batch.texture, scene.texture_seed),
                         static_cast<GLint>(vertices.size()), static_cast<GLsizei>(quads.size())});
      vertices.insert(vertices.end(), quads.begin(), quads.end());
    }
    GLuint buffer = 0;
    gl.GenBuffers(1, &buffer);
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
                  GL_STATIC_DRAW);
    const auto at = [](std::size_t offset) { return reinterpret_cast<const void*>(offset); };
    gl.VertexPointer(3, GL_FLOAT, sizeof(Vertex), at(offsetof(Vertex, position)));
    gl.TexCoordPointer(2, GL_FLOAT, sizeof(Vertex), at(offsetof(Vertex, uv)));
    gl.ColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), at(offsetof(Vertex, colour)));
  }

  void setState(const GlFunctions& gl) const {
    for (const GLenum array : {GL_VERTEX_ARRAY, GL_TEXTURE_COORD_ARRAY, GL_COLOR_ARRAY})
      gl.EnableClientState(array);
    for (const GLenum ability : {GL_DEPTH_TEST, GL_CULL_FACE, GL_MULTISAMPLE}) gl.Enable(ability);
    gl.Disable(GL_DITHER);
    gl.FrontFace(GL_CW);  // the picture stands on its head
    gl.DepthFunc(GL_LESS);
    gl.Viewport(0, 0, camera.width, camera.height);
    gl.MatrixMode(GL_PROJECTION);
    gl.LoadMatrixd(projectionOf(camera).data());
    gl.MatrixMode(GL_MODELVIEW);
  }

  // Part of the picture in which the room can be seen: seen from outside, what the opening spans.
  cv::Rect roomIn(const Eigen::Isometry3d& T_camera_window) const {
    const cv::Rect picture(0, 0, camera.width, camera.height);
    const bool outside = T_camera_window.inverse().translation().x() < -kNear_m;
    if (!outside) return picture;
    if (!opening) return {};
    const auto corners = geometry::projectOpening(camera, T_camera_window, *opening);
    if (!corners) return picture;
    Eigen::AlignedBox2d span;
    for (const auto& corner : *corners) span.extend(corner);
    const Eigen::Vector2d end(camera.width, camera.height);
    const Eigen::Vector2d low = span.min().cwiseMax(0.0).cwiseMin(end),
                          high = span.max().cwiseMax(-1.0).cwiseMin(end);
    const cv::Point first(static_cast<int>(std::floor(low.x())), static_cast<int>(std::floor(low.y())));
    const cv::Point last(static_cast<int>(std::ceil(high.x())), static_cast<int>(std::ceil(high.y())));
    if (last.x < first.x || last.y < first.y) return {};
    return cv::Rect(first, last + cv::Point(1, 1)) & picture;
  }

  void draw(const GlFunctions& gl, const Eigen::Isometry3d& T_camera_window) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, sampled);
    gl.Disable(GL_SCISSOR_TEST);
    gl.Clear(GL_DEPTH_BUFFER_BIT);  // the sky covers what nothing else does
    gl.LoadMatrixd(T_camera_window.matrix().data());
    const cv::Rect inside = roomIn(T_camera_window);
    gl.Scissor(inside.x, inside.y, inside.width, inside.height);
    for (const Batch& batch : batches) {
      if (batch.indoors && inside.empty()) continue;
      (batch.indoors ? gl.Enable : gl.Disable)(GL_SCISSOR_TEST);
      (batch.textured ? gl.Enable : gl.Disable)(GL_TEXTURE_2D);
      gl.BindTexture(GL_TEXTURE_2D, batch.texture);
      gl.DrawArrays(GL_QUADS, batch.first, batch.count);
    }
  }

  void read(const GlFunctions& gl, cv::Mat& image) {
    const int w = camera.width, h = camera.height;
    gl.Disable(GL_SCISSOR_TEST);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, sampled);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved);
    gl.BlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved);
    gl.ReadPixels(0, 0, w, h, GL_RGBA, GL_UNSIGNED_BYTE, bgra.data);
    cv::cvtColor(bgra, image, cv::COLOR_RGBA2BGR);
  }

  geometry::PinholeCamera camera;
  std::optional<geometry::OpeningSize> opening;
  GlContext context;
  GLuint sampled = 0, resolved = 0;
  std::vector<Batch> batches;
  cv::Mat bgra;
};

Renderer::Renderer(const Scene& scene, const geometry::PinholeCamera& camera) {
  requireUsable(camera);
  impl_ = std::make_unique<Impl>(scene, camera);
}

Renderer::~Renderer() = default;

void Renderer::render(const Eigen::Isometry3d& T_camera_window, cv::Mat& image) {
  const GlFunctions& gl = impl_->context.makeCurrent();
  impl_->draw(gl, T_camera_window);
  impl_->read(gl, image);
}

}  // namespace window_ingress::simulation
