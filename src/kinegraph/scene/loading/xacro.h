#pragma once

#include <string>

#include "kinegraph/scene/loading/file_options.h"

namespace kinegraph::inline scene_internal {

/// Expands a file by the function that was set. Throws FileError without one, with the command that converts the file.
std::string expandXacro(const std::string& path, const XacroArguments& arguments);

}  // namespace kinegraph::inline scene_internal
