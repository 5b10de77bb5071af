#pragma once

#include <array>
#include <string>
#include <vector>

#include "kinegraph/scene/frame.h"

namespace kinegraph {

/// Colors of points, rgba in 0..255: one per point, one for all, or none.
using PointColors = std::vector<std::array<std::uint8_t, 4>>;

/// Shows line segments between consecutive pairs of points (m), or with `connected` one line through all points. Throws
/// ValueError for an odd number of points, fewer than two, or a mismatched number of colors.
void setLines(Frame& frame, const std::vector<Vector3d>& points, const PointColors& colors = {},
              bool connected = false);

/// Sets the shape to the mesh of a file, scaled by `scale`. Throws FileError; the frame is then unchanged.
void setMeshFile(Frame& frame, const std::string& path, double scale = 1.);

/// Covers the frame's shape with a picture (PNG or JPEG). `texcoords` holds two numbers per vertex of its mesh: the
/// position in the picture, to the right and up, in 0..1. Throws FileError for the file, and ValueError for a frame
/// without a shape or coordinates of a wrong number; the frame is then unchanged.
void setTexture(Frame& frame, const std::string& path, const std::vector<double>& texcoords = {});

/// Sets the shape to a box of that size (m) that holds a grid of numbers.
void setTensor(Frame& frame, Grid grid, const Vector3d& size);

/// Sets the shape to the solid of non-positive grid values, in a box of that size (m). Positive values are the distance
/// to the solid (m). Throws ValueError for an invalid grid or size.
void setSdf(Frame& frame, Grid grid, const Vector3d& size);

/// Sets the shape to the zero level set of a grid in a box of that size (m); normals point to larger values. The grid
/// is blurred `blur` times first and, for `resample` > 0, resampled to cells of about that size (m).
void setImplicitSurface(Frame& frame, const Grid& grid, const Vector3d& size, int blur = 0, double resample = -1.);

}  // namespace kinegraph
