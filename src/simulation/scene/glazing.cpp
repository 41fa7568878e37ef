#include "simulation/scene/glazing.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simulation/surfaces/faces.hpp"

namespace window_ingress::simulation {
namespace {

constexpr int kCells = 16;  // per side of a pane; reflectance is interpolated linearly between cell corners

constexpr double kRefractiveIndex = 1.52;

double square(double value) { return value * value; }

double ofBothFaces(double of_one) { return 2.0 * of_one / (1.0 + of_one); }

// From clip coordinates to texture coordinates over the whole image.
Eigen::Matrix4d textureFromClip() {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() *= 0.5;
  matrix.topRightCorner<3, 1>().setConstant(0.5);
  return matrix;
}

Eigen::Vector3d pointOn(const Pane& pane, int across, int up) {
  const Eigen::Vector2d part(across / static_cast<double>(kCells), up / static_cast<double>(kCells));
  const Eigen::Vector2d point = pane.face_m.min() + part.cwiseProduct(pane.face_m.sizes());
  return {pane.x_m, point.x(), point.y()};
}

}  // namespace

double paneReflectance(double cos_incidence) {
  const double n = kRefractiveIndex, outside = std::clamp(cos_incidence, 0.0, 1.0);
  const double within = std::sqrt(1.0 - (1.0 - outside * outside) / (n * n));
  const double across = square((outside - n * within) / (outside + n * within));
  const double along = square((n * outside - within) / (n * outside + within));
  return 0.5 * (ofBothFaces(across) + ofBothFaces(along));
}

Eigen::Isometry3d mirrorAt(double x_m) {
  Eigen::Isometry3d mirror = Eigen::Isometry3d::Identity();
  mirror.linear()(0, 0) = -1.0;
  mirror.translation().x() = 2.0 * x_m;
  return mirror;
}

cv::Rect partAround(const geometry::PinholeCamera& camera,
                    const std::vector<Eigen::Vector3d>& points_camera) {
  Eigen::AlignedBox2d span;
  for (const Eigen::Vector3d& point : points_camera) {
    if (point.z() < kNear_m) return {0, 0, camera.width, camera.height};
    span.extend(Eigen::Vector2d(camera.fx * point.x() / point.z() + camera.cx,
                                camera.fy * point.y() / point.z() + camera.cy));
  }
  const Eigen::Vector2d end(camera.width, camera.height), none = Eigen::Vector2d::Constant(-1.0);
  const Eigen::Vector2d low = span.min().cwiseMax(0.0).cwiseMin(end),
                        high = span.max().cwiseMax(none).cwiseMin(end);
  const cv::Point first(static_cast<int>(std::floor(low.x())), static_cast<int>(std::floor(low.y())));
  const cv::Point last(static_cast<int>(std::ceil(high.x())), static_cast<int>(std::ceil(high.y())));
  if (last.x < first.x || last.y < first.y) return {};
  return cv::Rect(first, last + cv::Point(1, 1)) & cv::Rect(0, 0, camera.width, camera.height);
}

void Glazing::create(const GlFunctions& gl, const geometry::PinholeCamera& camera,
                     const std::vector<Pane>& panes) {
  camera_ = camera;
  panes_ = panes;
  if (panes_.empty()) return;
  gl.GenTextures(1, &texture_);
  gl.BindTexture(GL_TEXTURE_2D, texture_);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, camera.width, camera.height, 0, GL_RGB, GL_UNSIGNED_BYTE, nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  GLuint depths = 0;
  gl.GenRenderbuffers(1, &depths);
  gl.BindRenderbuffer(GL_RENDERBUFFER, depths);
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, camera.width, camera.height);
  gl.GenFramebuffers(1, &mirror_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, mirror_);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depths);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("OpenGL refuses a framebuffer for reflections in glass");
}

cv::Rect Glazing::partIn(const Eigen::Isometry3d& T_camera_window) const {
  cv::Rect part;
  const double eye_m = T_camera_window.inverse().translation().x();
  for (const Pane& pane : panes_) {
    if (eye_m >= pane.x_m) continue;
    std::vector<Eigen::Vector3d> corners;
    for (const auto& [across, up] : {std::pair(0, 0), {kCells, 0}, {kCells, kCells}, {0, kCells}})
      corners.emplace_back(T_camera_window * pointOn(pane, across, up));
    part |= partAround(camera_, corners);
  }
  return part;
}

Eigen::Isometry3d Glazing::beginMirror(const GlFunctions& gl,
                                       const Eigen::Isometry3d& T_camera_window) const {
  const Eigen::Isometry3d T_camera_mirrored = T_camera_window * mirrorAt(panes_.front().x_m);
  const double before_panes[] = {-1.0, 0.0, 0.0, panes_.front().x_m};
  gl.BindFramebuffer(GL_FRAMEBUFFER, mirror_);
  gl.LoadMatrixd(T_camera_mirrored.matrix().data());
  gl.ClipPlane(GL_CLIP_PLANE0, before_panes);
  gl.Enable(GL_CLIP_PLANE0);
  gl.FrontFace(GL_CCW);
  return T_camera_mirrored;
}

void Glazing::endMirror(const GlFunctions& gl) const {
  gl.FrontFace(GL_CW);
  gl.Disable(GL_CLIP_PLANE0);
}

void Glazing::addPane(const Pane& pane, const Eigen::Matrix4d& texture_from_window,
                      const Eigen::Vector3d& eye) {
  const auto first = static_cast<GLuint>(points_.size());
  for (int up = 0; up <= kCells; ++up)
    for (int across = 0; across <= kCells; ++across) {
      const Eigen::Vector3d p = pointOn(pane, across, up), sight = p - eye;
      const Eigen::Vector4f at = (texture_from_window * p.homogeneous()).cast<float>();
      const auto part = static_cast<float>(paneReflectance(sight.x() / sight.norm()));
      points_.push_back({p.cast<float>(), at, {1.0F, 1.0F, 1.0F, part}});
    }
  for (GLuint row = 0; row < kCells; ++row)
    for (GLuint column = 0; column < kCells; ++column) {
      const GLuint corner = first + row * (kCells + 1) + column;
      corners_.insert(corners_.end(), {corner, corner + 1, corner + kCells + 2, corner + kCells + 1});
    }
}

void Glazing::draw(const GlFunctions& gl, const Eigen::Matrix4d& projection,
                   const Eigen::Isometry3d& T_camera_window) {
  points_.clear();
  corners_.clear();
  const Eigen::Vector3d eye = T_camera_window.inverse().translation();
  const Eigen::Matrix4d texture_from_window = textureFromClip() * projection * T_camera_window.matrix();
  for (const Pane& pane : panes_) addPane(pane, texture_from_window, eye);
  gl.BindBuffer(GL_ARRAY_BUFFER, 0);
  gl.VertexPointer(3, GL_FLOAT, sizeof(Point), points_.front().position.data());
  gl.TexCoordPointer(4, GL_FLOAT, sizeof(Point), points_.front().mirrored.data());
  gl.ColorPointer(4, GL_FLOAT, sizeof(Point), points_.front().colour.data());
  gl.BindTexture(GL_TEXTURE_2D, texture_);
  gl.Enable(GL_TEXTURE_2D);
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  gl.Disable(GL_CULL_FACE);
  gl.DrawElements(GL_QUADS, static_cast<GLsizei>(corners_.size()), GL_UNSIGNED_INT, corners_.data());
  gl.Enable(GL_CULL_FACE);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.Disable(GL_BLEND);
}

}  // namespace window_ingress::simulation
