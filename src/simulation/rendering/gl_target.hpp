#pragma once

#include <opencv2/core.hpp>
#include <stdexcept>

#include "simulation/rendering/gl_functions.hpp"

namespace window_ingress::simulation {

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
