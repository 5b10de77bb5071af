#pragma once

#include "kinegraph/scene/loading/xacro.h"

namespace kinegraph {

/// How a scene file is read.
struct FileOptions {
  bool strict = false;   ///< warnings about the file are errors
  XacroArguments xacro;  ///< arguments of a .xacro file
  bool floating =
      false;  ///< gives the root frame a free joint below a new frame `world`, so that a legged robot falls in
              ///< a simulation; ValueError if the file has several roots, or a root that cannot move
};

}  // namespace kinegraph
