#pragma once

#include <cstddef>

#include "kinegraph/rendering/gl/gl_context.h"

namespace kinegraph::inline rendering_internal {

/// Constants of OpenGL 3.3, declared here because its headers may not be installed.
namespace gl {
constexpr unsigned kPoints = 0, kTriangles = 4, kLess = 0x201, kLessOrEqual = 0x203, kFront = 0x404, kBack = 0x405,
                   kEqual = 0x202, kGreater = 0x204, kAlways = 0x207,

                   kFrontAndBack = 0x408, kCullFace = 0xB44, kDepthTest = 0xB71, kBlend = 0xBE2, kTexture2D = 0xDE1,
                   kUnsignedByte = 0x1401, kFloat = 0x1406, kDepthComponent = 0x1902, kRgb = 0x1907, kRgba = 0x1908,
                   kLine = 0x1B01, kFill = 0x1B02, kOne = 1, kSourceAlpha = 0x302, kOneMinusSourceAlpha = 0x303,
                   kLinear = 0x2601, kLinearMipmap = 0x2703, kMagFilter = 0x2800, kMinFilter = 0x2801, kWrapS = 0x2802,
                   kWrapT = 0x2803, kRepeat = 0x2901, kRgba8 = 0x8058, kSrgb8 = 0x8C41, kClampToEdge = 0x812F,
                   kDepth24 = 0x81A6, kTexture0 = 0x84C0, kProgramPointSize = 0x8642, kCompareMode = 0x884C,
                   kCompareFunction = 0x884D, kCompareToReference = 0x884E, kArrayBuffer = 0x8892,
                   kIndexBuffer = 0x8893, kStaticDraw = 0x88E4, kFragmentShader = 0x8B30, kVertexShader = 0x8B31,
                   kCompiled = 0x8B81, kLinked = 0x8B82, kDepth32F = 0x8CAC, kComplete = 0x8CD5,
                   kColorAttachment = 0x8CE0, kDepthAttachment = 0x8D00, kFramebuffer = 0x8D40, kPackAlignment = 0xD05,
                   kUnpackAlignment = 0xCF5, kColorBit = 0x4000, kColor = 0x1800, kDepth = 0x1801, kScissorTest = 0xC11,
                   kNearest = 0x2600, kUnsignedInt = 0x1405, kRgInteger = 0x8228, kRg32ui = 0x823C, kDepthBit = 0x100,
                   kNone = 0;
}  // namespace gl

/// The used functions of OpenGL, by their own names without the prefix.
struct GlFunctions {
  void (*ActiveTexture)(unsigned);
  void (*AttachShader)(unsigned, unsigned);
  void (*BindBuffer)(unsigned, unsigned);
  void (*BindFramebuffer)(unsigned, unsigned);
  void (*BindTexture)(unsigned, unsigned);
  void (*BindVertexArray)(unsigned);
  void (*BlendFuncSeparate)(unsigned, unsigned, unsigned, unsigned);
  void (*BufferData)(unsigned, std::ptrdiff_t, const void*, unsigned);
  unsigned (*CheckFramebufferStatus)(unsigned);
  void (*Clear)(unsigned);
  void (*ClearBufferfv)(unsigned, int, const float*);
  void (*ClearBufferuiv)(unsigned, int, const unsigned*);
  void (*ClearColor)(float, float, float, float);
  void (*ColorMask)(unsigned char, unsigned char, unsigned char, unsigned char);
  void (*CompileShader)(unsigned);
  unsigned (*CreateProgram)();
  unsigned (*CreateShader)(unsigned);
  void (*CullFace)(unsigned);
  void (*DeleteBuffers)(int, const unsigned*);
  void (*DeleteFramebuffers)(int, const unsigned*);
  void (*DeleteProgram)(unsigned);
  void (*DeleteShader)(unsigned);
  void (*DeleteTextures)(int, const unsigned*);
  void (*DeleteVertexArrays)(int, const unsigned*);
  void (*DepthFunc)(unsigned);
  void (*DepthMask)(unsigned char);
  void (*Disable)(unsigned);
  void (*DrawArrays)(unsigned, int, int);
  void (*DrawBuffer)(unsigned);
  void (*DrawElements)(unsigned, int, unsigned, const void*);
  void (*Enable)(unsigned);
  void (*EnableVertexAttribArray)(unsigned);
  void (*FramebufferTexture2D)(unsigned, unsigned, unsigned, unsigned, int);
  void (*GenBuffers)(int, unsigned*);
  void (*GenerateMipmap)(unsigned);
  void (*GenFramebuffers)(int, unsigned*);
  void (*GenTextures)(int, unsigned*);
  void (*GenVertexArrays)(int, unsigned*);
  void (*GetProgramInfoLog)(unsigned, int, int*, char*);
  void (*GetProgramiv)(unsigned, unsigned, int*);
  void (*GetShaderInfoLog)(unsigned, int, int*, char*);
  void (*GetShaderiv)(unsigned, unsigned, int*);
  int (*GetUniformLocation)(unsigned, const char*);
  void (*LinkProgram)(unsigned);
  void (*PixelStorei)(unsigned, int);
  void (*PolygonMode)(unsigned, unsigned);
  void (*ReadBuffer)(unsigned);
  void (*ReadPixels)(int, int, int, int, unsigned, unsigned, void*);
  void (*Scissor)(int, int, int, int);
  void (*ShaderSource)(unsigned, int, const char* const*, const int*);
  void (*TexImage2D)(unsigned, int, int, int, int, int, unsigned, unsigned, const void*);
  void (*TexParameteri)(unsigned, unsigned, int);
  void (*Uniform1f)(int, float);
  void (*Uniform1i)(int, int);
  void (*Uniform2f)(int, float, float);
  void (*Uniform3fv)(int, int, const float*);
  void (*Uniform4fv)(int, int, const float*);
  void (*UniformMatrix4fv)(int, int, unsigned char, const float*);
  void (*UseProgram)(unsigned);
  void (*VertexAttribPointer)(unsigned, int, unsigned, unsigned char, int, const void*);
  void (*Viewport)(int, int, int, int);
};

/// Returns the functions of OpenGL; a context must be in use at the first call. Throws FileError with the name of a
/// function that the driver lacks.
const GlFunctions& glFunctions();

}  // namespace kinegraph::inline rendering_internal
