#include "kinegraph/rendering/gl/gl_program.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline rendering_internal {

namespace {

constexpr int kLog = 4096;  // bytes of the driver's words

unsigned compiled(const GlFunctions& functions, unsigned kind, const std::string& source) {
  const unsigned shader = functions.CreateShader(kind);
  const char* text = source.c_str();
  functions.ShaderSource(shader, 1, &text, nullptr);
  functions.CompileShader(shader);
  int good = 0;
  functions.GetShaderiv(shader, gl::kCompiled, &good);
  if (good) return shader;
  std::string log(kLog, '\0');
  functions.GetShaderInfoLog(shader, kLog, nullptr, log.data());
  functions.DeleteShader(shader);
  throw Error(cat("pictures need OpenGL 3.3; its driver says: ", log.c_str()));
}

}  // namespace

GlProgram::GlProgram(const std::string& vertex, const std::string& fragment) : gl_(glFunctions()) {
  const unsigned first = compiled(gl_, gl::kVertexShader, vertex);
  const unsigned second = compiled(gl_, gl::kFragmentShader, fragment);
  id_ = gl_.CreateProgram();
  for (const unsigned shader : {first, second}) {
    gl_.AttachShader(id_, shader);
    gl_.DeleteShader(shader);
  }
  gl_.LinkProgram(id_);
  int good = 0;
  gl_.GetProgramiv(id_, gl::kLinked, &good);
  if (good) return;
  std::string log(kLog, '\0');
  gl_.GetProgramInfoLog(id_, kLog, nullptr, log.data());
  gl_.DeleteProgram(id_);
  throw Error(cat("pictures need OpenGL 3.3; its driver says: ", log.c_str()));
}

GlProgram::~GlProgram() { gl_.DeleteProgram(id_); }

int GlProgram::at(const char* name) {
  const auto known = places_.find(name);
  return known != places_.end() ? known->second : places_[name] = gl_.GetUniformLocation(id_, name);
}

void GlProgram::set(const char* name, const Eigen::Vector3d& value) {
  const Eigen::Vector3f numbers = value.cast<float>();
  gl_.Uniform3fv(at(name), 1, numbers.data());
}

void GlProgram::set(const char* name, const Eigen::Vector4d& value) {
  const Eigen::Vector4f numbers = value.cast<float>();
  gl_.Uniform4fv(at(name), 1, numbers.data());
}

void GlProgram::set(const char* name, const Eigen::Matrix4d& value) {
  const Eigen::Matrix4f numbers = value.cast<float>();
  gl_.UniformMatrix4fv(at(name), 1, 0, numbers.data());
}

void GlProgram::set(const char* name, const std::vector<Eigen::Vector3d>& values) {
  std::vector<float> numbers;
  for (const Eigen::Vector3d& value : values) {
    for (const double x : value) numbers.push_back(float(x));
  }
  gl_.Uniform3fv(at(name), int(values.size()), numbers.data());
}

}  // namespace kinegraph::inline rendering_internal
