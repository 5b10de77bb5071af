#include "kinegraph/rendering/gl/gl_frame.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/rendering/gl/gl_functions.h"

namespace kinegraph::inline rendering_internal {

namespace {

unsigned newTexture() {
  const GlFunctions& f = glFunctions();
  unsigned texture = 0;
  f.GenTextures(1, &texture);
  f.BindTexture(gl::kTexture2D, texture);
  for (const unsigned filter : {gl::kMinFilter, gl::kMagFilter})
    f.TexParameteri(gl::kTexture2D, filter, int(gl::kNearest));
  for (const unsigned direction : {gl::kWrapS, gl::kWrapT})
    f.TexParameteri(gl::kTexture2D, direction, int(gl::kClampToEdge));
  return texture;
}

}  // namespace

GlFrame::GlFrame(Colors colors) : colors_(colors), owns_depth_(true) {
  glFunctions().GenFramebuffers(1, &frame_);
  if (colors != Colors::none) color_ = newTexture();
  depth_ = newTexture();
}

GlFrame::GlFrame(Colors colors, const GlFrame& depths_of)
    : colors_(colors), owns_depth_(false), depth_(depths_of.depth_) {
  glFunctions().GenFramebuffers(1, &frame_);
  if (colors != Colors::none) color_ = newTexture();
}

GlFrame::~GlFrame() {
  const GlFunctions& f = glFunctions();
  f.DeleteFramebuffers(1, &frame_);
  if (color_) f.DeleteTextures(1, &color_);
  if (owns_depth_) f.DeleteTextures(1, &depth_);
}

void GlFrame::use(int width, int height) {
  const GlFunctions& f = glFunctions();
  f.BindFramebuffer(gl::kFramebuffer, frame_);
  f.Viewport(0, 0, width, height);
  if (width <= width_ && height <= height_) return;
  width_ = std::max(width, width_);
  height_ = std::max(height, height_);
  if (colors_ == Colors::rgba) {
    f.BindTexture(gl::kTexture2D, color_);
    f.TexImage2D(gl::kTexture2D, 0, int(gl::kRgba8), width_, height_, 0, gl::kRgba, gl::kUnsignedByte, nullptr);
  } else if (colors_ == Colors::integers) {
    f.BindTexture(gl::kTexture2D, color_);
    f.TexImage2D(gl::kTexture2D, 0, int(gl::kRg32ui), width_, height_, 0, gl::kRgInteger, gl::kUnsignedInt, nullptr);
  } else {
    f.DrawBuffer(gl::kNone);
    f.ReadBuffer(gl::kNone);
  }
  if (color_) f.FramebufferTexture2D(gl::kFramebuffer, gl::kColorAttachment, gl::kTexture2D, color_, 0);
  if (owns_depth_) {
    f.BindTexture(gl::kTexture2D, depth_);
    f.TexImage2D(gl::kTexture2D, 0, int(gl::kDepth32F), width_, height_, 0, gl::kDepthComponent, gl::kFloat, nullptr);
  }
  f.FramebufferTexture2D(gl::kFramebuffer, gl::kDepthAttachment, gl::kTexture2D, depth_, 0);
  if (f.CheckFramebufferStatus(gl::kFramebuffer) == gl::kComplete) return;
  width_ = height_ = 0;
  throw Error(cat("the OpenGL driver cannot draw images of ", width, " x ", height, " pixels"));
}

}  // namespace kinegraph::inline rendering_internal
