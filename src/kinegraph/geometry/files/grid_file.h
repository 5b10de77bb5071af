#pragma once

#include <string>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

struct GridFile {
  Grid grid;
  Vector3d size;  ///< of the box, centered at the origin, m
};

/// Reads numbers on a grid over a box (a signed distance field, m) from
/// - a text file with `lo: [x y z]` and `up: [x y z]`, the box's corners (or both as `bounds`), and
///   `field: <nx ny nz> [ ... ]`, last index fastest; numbers between zero bytes instead of brackets are 32-bit
///   floats, as
///   RAI writes them;
/// - an HDF5 file with datasets of these names, `field` with three dimensions.
/// Throws FileError with the file, the content found and the content expected.
GridFile readGridFile(const std::string& path);

}  // namespace kinegraph::inline geometry_internal
