#pragma once

#include <string>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline exporters_internal {

/// Writes the triangles of a mesh as a binary STL file. Throws FileError.
void writeStl(const Mesh& mesh, const std::string& path);

}  // namespace kinegraph::inline exporters_internal
