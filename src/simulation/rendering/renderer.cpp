#include "simulation/rendering/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "simulation/rendering/edge_smoother.hpp"
#include "simulation/rendering/gl_context.hpp"
#include "simulation/scene/glazing.hpp"
#include "simulation/surfaces/faces.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::simulation {
namespace {

constexpr double kFar_m = 1000.0;

// Projection from the optical frame to clip coordinates. Row 0 of the image is OpenGL's lowest row, so that
// no row moves after reading. Pixel u has its centre at u + 0.5 in OpenGL's window.
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

// Filter per texture. Reading four texels costs more than everything else together, and blending two levels
// as much again. The difference is visible only in regular patterns, where levels meet.
struct Filter {
  GLint minifying, magnifying;
  int enlarged;  // factor by which the texture is refined first
};

Filter filterOf(Texture texture) {
  switch (texture) {
    case Texture::kPlaster:
    case Texture::kPaint:
      return {GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST, 2};
    case Texture::kGrass:
    case Texture::kHedge:
    case Texture::kClouds:
      return {GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST, 1};
    case Texture::kBrick:
    case Texture::kStone:
    case Texture::kSiding:
    case Texture::kLouvres:
    case Texture::kTiles:
    case Texture::kPaving:
      return {GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, 1};
    default:
      return {GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR, 1};
  }
}

void requireUsable(const geometry::PinholeCamera& camera) {
  const auto faults = camera.validate();
  if (!faults.empty()) throw std::invalid_argument("Renderer: " + parameters::joined(faults));
  if (camera.hasDistortion()) throw std::invalid_argument("Renderer: draws without distortion only");
}

}  // namespace

struct Renderer::Impl {
  Impl(const Scene& scene, const geometry::PinholeCamera& ideal, Antialiasing kind,
       std::shared_ptr<GlContext> given)
      : camera(ideal),
        opening(scene.opening),
        other_clear_holes(scene.other_clear_holes),
        fog(scene.fog),
        antialiasing(kind),
        context(std::move(given)),
        faces(facesOf(scene.mesh)),
        smoother(ideal),
        rgba(ideal.height, ideal.width, CV_8UC4) {
    const CurrentContext current(*context);
    const GlFunctions& gl = current.gl();
    target.create(gl, rgba.size(), kind == Antialiasing::kMultisampling ? 4 : 0);
    upload(gl, scene);
    setState(gl);
    glazing.create(gl, camera, scene.panes);
    if (fog) setFog(gl);
    if (gl.GetError() != GL_NO_ERROR)
      throw std::runtime_error("OpenGL reports an error while loading the scene");
  }

  static GLuint uploadTexture(const GlFunctions& gl, Texture kind, std::uint32_t seed) {
    const Filter filter = filterOf(kind);
    cv::Mat image = makeTexture(kind, seed);
    if (filter.enlarged > 1) cv::resize(image, image, image.size() * filter.enlarged, 0, 0, cv::INTER_CUBIC);
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.cols, image.rows, 0, GL_RGB, GL_UNSIGNED_BYTE,
                  image.data);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter.minifying);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter.magnifying);
    gl.GenerateMipmap(GL_TEXTURE_2D);
    return texture;
  }

  // The surface's number replaces the colour's fourth component, and is read back with the image.
  void upload(const GlFunctions& gl, const Scene& scene) {
    std::vector<Vertex> vertices;
    for (const auto& [batch, corners] : scene.mesh.batches()) {
      if (textures.count(batch.texture) == 0)
        textures[batch.texture] = uploadTexture(gl, batch.texture, scene.texture_seed);
      vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i].colour[3] = faces[i / 4].surface;
    gl.GenBuffers(1, &buffer);
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
                  GL_STATIC_DRAW);
    pointToFaces(gl);
  }

  void pointToFaces(const GlFunctions& gl) const {
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
    const auto at = [](std::size_t offset) { return reinterpret_cast<const void*>(offset); };
    gl.VertexPointer(3, GL_FLOAT, sizeof(Vertex), at(offsetof(Vertex, position)));
    gl.TexCoordPointer(2, GL_FLOAT, sizeof(Vertex), at(offsetof(Vertex, uv)));
    gl.ColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), at(offsetof(Vertex, colour)));
  }

  void setState(const GlFunctions& gl) const {
    for (const GLenum array : {GL_VERTEX_ARRAY, GL_TEXTURE_COORD_ARRAY, GL_COLOR_ARRAY})
      gl.EnableClientState(array);
    for (const GLenum ability : {GL_DEPTH_TEST, GL_CULL_FACE, GL_MULTISAMPLE, GL_SCISSOR_TEST})
      gl.Enable(ability);
    gl.Disable(GL_DITHER);
    gl.FrontFace(GL_CW);  // the image is upside down
    gl.DepthFunc(GL_LESS);
    gl.Viewport(0, 0, camera.width, camera.height);
    gl.MatrixMode(GL_PROJECTION);
    gl.LoadMatrixd(projectionOf(camera).data());
    gl.MatrixMode(GL_MODELVIEW);
  }

  void setFog(const GlFunctions& gl) const {
    const Eigen::Vector4f colour = fog->colour.homogeneous().cast<float>();
    gl.Enable(GL_FOG);
    gl.Fogi(GL_FOG_DISTANCE_MODE_NV, GL_EYE_PLANE);  // signed distance: faces extend behind the camera
    gl.Fogf(GL_FOG_DENSITY, static_cast<GLfloat>(fog->density_per_m));
    gl.Fogfv(GL_FOG_COLOR, colour.data());
  }

  // There is no fog in the room: objects there keep the contrast that is left at the wall. OpenGL computes
  // fog from depth only; over a long enough range it is the same for all depths.
  void setFogOf(const GlFunctions& gl, bool indoors, double way_to_wall_m) const {
    constexpr float kRange_m = 1e7F;
    const auto kept = static_cast<float>(std::exp(-fog->density_per_m * std::max(0.0, way_to_wall_m)));
    gl.Fogi(GL_FOG_MODE, indoors ? GL_LINEAR : GL_EXP);
    gl.Fogf(GL_FOG_END, kept * kRange_m);
    gl.Fogf(GL_FOG_START, (kept - 1.0F) * kRange_m);
  }

  // Part of the image in which the room is visible: seen from outside, the opening's extent.
  cv::Rect roomIn(const Eigen::Isometry3d& T_camera_window) const {
    const cv::Rect image(0, 0, camera.width, camera.height);
    if (other_clear_holes) return image;
    const bool outside = T_camera_window.inverse().translation().x() < -kNear_m;
    if (!outside) return image;
    if (!opening) return {};
    std::vector<Eigen::Vector3d> corners;
    for (const auto& corner : geometry::openingCorners(*opening))
      corners.emplace_back(T_camera_window * corner);
    return partAround(camera, corners);
  }

  static void scissor(const GlFunctions& gl, const cv::Rect& part) {
    gl.Scissor(part.x, part.y, part.width, part.height);
  }

  void draw(const GlFunctions& gl, const Eigen::Isometry3d& T_camera_window, const cv::Range& rows) {
    const cv::Rect part(0, rows.start, camera.width, rows.size());
    const cv::Rect indoors = roomIn(T_camera_window) & part, panes = glazing.partIn(T_camera_window) & part;
    if (!panes.empty()) drawMirrored(gl, T_camera_window, panes);
    visible = visibleFaces(faces, camera, T_camera_window, !indoors.empty());
    target.bind(gl);
    drawFaces(gl, T_camera_window, visible, part, indoors);
    if (!panes.empty()) drawPanes(gl, T_camera_window, panes);
  }

  void drawMirrored(const GlFunctions& gl, const Eigen::Isometry3d& T_camera_window, const cv::Rect& part) {
    const Eigen::Isometry3d T_camera_mirrored = glazing.beginMirror(gl, T_camera_window);
    drawFaces(gl, T_camera_mirrored, visibleFaces(faces, camera, T_camera_mirrored, false), part, {});
    glazing.endMirror(gl);
  }

  // Without fog, because the scene behind the panes and its mirror image contain the fog already.
  void drawPanes(const GlFunctions& gl, const Eigen::Isometry3d& T_camera_window, const cv::Rect& part) {
    scissor(gl, part);
    gl.LoadMatrixd(T_camera_window.matrix().data());
    if (fog) gl.Disable(GL_FOG);
    glazing.draw(gl, projectionOf(camera), T_camera_window);
    if (fog) gl.Enable(GL_FOG);
    pointToFaces(gl);
  }

  // Draws near faces first, because they hide far ones before those are painted. Consecutive faces with the
  // same texture are drawn at once.
  void drawFaces(const GlFunctions& gl, const Eigen::Isometry3d& T_camera_window,
                 const std::vector<std::size_t>& order, const cv::Rect& part, const cv::Rect& indoors) {
    gl.Enable(GL_SCISSOR_TEST);
    scissor(gl, part);
    gl.Clear(GL_DEPTH_BUFFER_BIT);  // the sky covers every other pixel
    gl.LoadMatrixd(T_camera_window.matrix().data());
    for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
      const Mesh::Batch& batch = faces[order[first]].batch;
      indices.clear();
      for (end = first; end < order.size() && same(batch, faces[order[end]].batch); ++end)
        for (GLuint corner = 0; corner < 4; ++corner)
          indices.push_back(static_cast<GLuint>(4 * order[end]) + corner);
      scissor(gl, batch.indoors ? indoors : part);
      if (fog) setFogOf(gl, batch.indoors, -T_camera_window.inverse().translation().x());
      drawRun(gl, batch.texture);
    }
  }

  static bool same(const Mesh::Batch& a, const Mesh::Batch& b) { return !(a < b) && !(b < a); }

  void drawRun(const GlFunctions& gl, Texture texture) const {
    (texture != Texture::kPlain ? gl.Enable : gl.Disable)(GL_TEXTURE_2D);
    gl.BindTexture(GL_TEXTURE_2D, textures.at(texture));
    gl.DrawElements(GL_QUADS, static_cast<GLsizei>(indices.size()), GL_UNSIGNED_INT, indices.data());
  }

  void render(const Eigen::Isometry3d& T_camera_window, const cv::Range& rows, cv::Mat& image) {
    {
      const CurrentContext current(*context);
      draw(current.gl(), T_camera_window, rows);
      target.read(current.gl(), rows, rgba);
    }
    cv::Mat part = image.rowRange(rows);
    cv::cvtColor(rgba.rowRange(rows), part, cv::COLOR_RGBA2BGR);
    if (antialiasing == Antialiasing::kEdges)
      smoother.smooth(faces, visible, T_camera_window, rgba, rows, image);
  }

  geometry::PinholeCamera camera;
  std::optional<geometry::OpeningSize> opening;
  bool other_clear_holes;
  std::optional<Fog> fog;
  Antialiasing antialiasing;
  std::shared_ptr<GlContext> context;
  GlTarget target;
  std::vector<Face> faces;
  Glazing glazing;
  std::vector<std::size_t> visible;
  EdgeSmoother smoother;
  GLuint buffer = 0;
  std::map<Texture, GLuint> textures;
  std::vector<GLuint> indices;
  cv::Mat rgba;
};

Renderer::Renderer(const Scene& scene, const geometry::PinholeCamera& camera, Antialiasing antialiasing,
                   std::shared_ptr<GlContext> context) {
  requireUsable(camera);
  impl_ = std::make_unique<Impl>(scene, camera, antialiasing, context ? std::move(context) : makeGlContext());
}

Renderer::~Renderer() = default;

void Renderer::render(const Eigen::Isometry3d& T_camera_window, cv::Mat& image) {
  renderRows(T_camera_window, cv::Range(0, impl_->camera.height), image);
}

void Renderer::renderRows(const Eigen::Isometry3d& T_camera_window, const cv::Range& rows, cv::Mat& image) {
  image.create(impl_->camera.height, impl_->camera.width, CV_8UC3);
  impl_->render(T_camera_window, rows, image);
}

}  // namespace window_ingress::simulation
