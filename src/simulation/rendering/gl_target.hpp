#pragma once

#include <opencv2/core.hpp>

#include "simulation/rendering/gl_functions.hpp"

namespace window_ingress::simulation {

/// What is drawn into: an image and its depths, with one or several samples a pixel.
class GlTarget {
 public:
  /// \throws std::runtime_error if OpenGL refuses
  void create(const GlFunctions& gl, const cv::Size& size, int samples);
  void bind(const GlFunctions& gl) const { gl.BindFramebuffer(GL_FRAMEBUFFER, drawn_); }
  /// Rows `rows` into those of `rgba` (CV_8UC4); several samples are averaged.
  void read(const GlFunctions& gl, const cv::Range& rows, cv::Mat& rgba) const;

 private:
  void attach(const GlFunctions& gl, GLenum attachment, GLenum format, int samples) const;

  cv::Size size_;
  GLuint drawn_ = 0, averaged_ = 0;
};

}  // namespace window_ingress::simulation
