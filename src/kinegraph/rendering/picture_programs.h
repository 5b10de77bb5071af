#pragma once

#include <initializer_list>
#include <optional>
#include <string>

#include "kinegraph/rendering/gl/gl_program.h"

namespace kinegraph::inline rendering_internal {

/// A program that is compiled at its first use.
class PictureProgram {
 public:
  /// Joins the parts of its fragment shader.
  PictureProgram(const char* vertex, std::initializer_list<std::string> fragment);

  GlProgram& compiled() {
    if (!program_) program_.emplace(vertex_, fragment_);
    return *program_;
  }

  unsigned described_in = 0;  ///< number of the last picture whose view it knows

 private:
  std::string vertex_, fragment_;
  std::optional<GlProgram> program_;
};

/// The programs that draw shapes.
struct ShapePrograms {
  PictureProgram surface, textured, lines, points;
};

/// All programs of pictures. See the shaders of these names.
struct PicturePrograms {
  explicit PicturePrograms(int lights);

  int lights;  ///< number of lights with a direction

  ShapePrograms samples, glass;
  PictureProgram kinds, alike_surface, mixed_surface, glass_pixel;
  PictureProgram floor_lines, floor_shadows, floor_before, floor_depth;
};

}  // namespace kinegraph::inline rendering_internal
