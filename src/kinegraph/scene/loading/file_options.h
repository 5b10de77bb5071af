#pragma once

#include "kinegraph/scene/loading/xacro.h"

namespace kinegraph {

/// How a scene file is read.
struct FileOptions {
  bool strict = false;     ///< warnings about the file are errors
  XacroArguments xacro{};  ///< arguments of a .xacro file
  /// Gives the root frame a free joint below a new frame `world`; a legged robot then falls in a simulation. Throws
  /// ValueError if the file has several roots, or a root that cannot move.
  bool floating = false;
  bool orphans = false;  ///< a frame with an unknown parent has none, and a warning, instead of an error
};

}  // namespace kinegraph
