#include "kinegraph/rendering/gl/gl_functions.h"

#include <type_traits>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline rendering_internal {

namespace {

GlFunctions loadGl() {
  GlFunctions functions;
  const auto load = [](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(GlContext::function(name));
    if (!function) throw FileError(cat("pictures need OpenGL 3.3, but the driver has no ", name));
  };
  load(functions.ActiveTexture, "glActiveTexture");
  load(functions.AttachShader, "glAttachShader");
  load(functions.BindBuffer, "glBindBuffer");
  load(functions.BindFramebuffer, "glBindFramebuffer");
  load(functions.BindTexture, "glBindTexture");
  load(functions.BindVertexArray, "glBindVertexArray");
  load(functions.BlendFuncSeparate, "glBlendFuncSeparate");
  load(functions.BufferData, "glBufferData");
  load(functions.CheckFramebufferStatus, "glCheckFramebufferStatus");
  load(functions.Clear, "glClear");
  load(functions.ClearBufferfv, "glClearBufferfv");
  load(functions.ClearBufferuiv, "glClearBufferuiv");
  load(functions.ClearColor, "glClearColor");
  load(functions.ColorMask, "glColorMask");
  load(functions.CompileShader, "glCompileShader");
  load(functions.CreateProgram, "glCreateProgram");
  load(functions.CreateShader, "glCreateShader");
  load(functions.CullFace, "glCullFace");
  load(functions.DeleteBuffers, "glDeleteBuffers");
  load(functions.DeleteFramebuffers, "glDeleteFramebuffers");
  load(functions.DeleteProgram, "glDeleteProgram");
  load(functions.DeleteShader, "glDeleteShader");
  load(functions.DeleteTextures, "glDeleteTextures");
  load(functions.DeleteVertexArrays, "glDeleteVertexArrays");
  load(functions.DepthFunc, "glDepthFunc");
  load(functions.DepthMask, "glDepthMask");
  load(functions.Disable, "glDisable");
  load(functions.DrawArrays, "glDrawArrays");
  load(functions.DrawBuffer, "glDrawBuffer");
  load(functions.DrawElements, "glDrawElements");
  load(functions.Enable, "glEnable");
  load(functions.EnableVertexAttribArray, "glEnableVertexAttribArray");
  load(functions.FramebufferTexture2D, "glFramebufferTexture2D");
  load(functions.GenBuffers, "glGenBuffers");
  load(functions.GenerateMipmap, "glGenerateMipmap");
  load(functions.GenFramebuffers, "glGenFramebuffers");
  load(functions.GenTextures, "glGenTextures");
  load(functions.GenVertexArrays, "glGenVertexArrays");
  load(functions.GetProgramInfoLog, "glGetProgramInfoLog");
  load(functions.GetProgramiv, "glGetProgramiv");
  load(functions.GetShaderInfoLog, "glGetShaderInfoLog");
  load(functions.GetShaderiv, "glGetShaderiv");
  load(functions.GetUniformLocation, "glGetUniformLocation");
  load(functions.LinkProgram, "glLinkProgram");
  load(functions.PixelStorei, "glPixelStorei");
  load(functions.PolygonMode, "glPolygonMode");
  load(functions.ReadBuffer, "glReadBuffer");
  load(functions.ReadPixels, "glReadPixels");
  load(functions.Scissor, "glScissor");
  load(functions.ShaderSource, "glShaderSource");
  load(functions.TexImage2D, "glTexImage2D");
  load(functions.TexParameteri, "glTexParameteri");
  load(functions.Uniform1f, "glUniform1f");
  load(functions.Uniform1i, "glUniform1i");
  load(functions.Uniform2f, "glUniform2f");
  load(functions.Uniform3fv, "glUniform3fv");
  load(functions.Uniform4fv, "glUniform4fv");
  load(functions.UniformMatrix4fv, "glUniformMatrix4fv");
  load(functions.UseProgram, "glUseProgram");
  load(functions.VertexAttribPointer, "glVertexAttribPointer");
  load(functions.Viewport, "glViewport");
  return functions;
}

}  // namespace

const GlFunctions& glFunctions() {
  static const GlFunctions loaded = loadGl();
  return loaded;
}

}  // namespace kinegraph::inline rendering_internal
