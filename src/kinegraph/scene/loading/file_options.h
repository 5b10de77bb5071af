#pragma once

#include "kinegraph/scene/loading/xacro.h"

namespace kinegraph {

/// How a scene file is read.
struct FileOptions {
  bool strict = false;   ///< warnings about the file are errors
  XacroArguments xacro;  ///< arguments of a .xacro file
};

}  // namespace kinegraph
