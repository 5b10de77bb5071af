#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "kinegraph/rendering/gl/gl_functions.h"

namespace kinegraph::inline rendering_internal {

/// A program of shaders with its parameters. Its context must be in use for all calls.
class GlProgram {
 public:
  /// Compiles it. Throws Error with the driver's words if that fails.
  GlProgram(const std::string& vertex, const std::string& fragment);
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  /// Selects it for set() and for drawing.
  void use() const { gl_.UseProgram(id_); }

  /// Set a parameter; unknown names, and those the driver has optimized away, are ignored.
  void set(const char* name, int value) { gl_.Uniform1i(at(name), value); }
  void set(const char* name, double value) { gl_.Uniform1f(at(name), float(value)); }
  void set(const char* name, const Eigen::Vector2d& value) {
    gl_.Uniform2f(at(name), float(value[0]), float(value[1]));
  }
  void set(const char* name, const Eigen::Vector3d& value);
  void set(const char* name, const Eigen::Vector4d& value);
  void set(const char* name, const Eigen::Matrix4d& value);
  void set(const char* name, const std::vector<Eigen::Vector3d>& values);

 private:
  int at(const char* name);

  const GlFunctions& gl_;
  unsigned id_;
  std::map<std::string, int, std::less<>> places_;
};

}  // namespace kinegraph::inline rendering_internal
