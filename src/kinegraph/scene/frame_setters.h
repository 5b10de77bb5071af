#pragma once

#include <array>
#include <string>
#include <vector>

#include "kinegraph/gfile/value.h"
#include "kinegraph/scene/frame.h"

namespace kinegraph {

/// Sets attributes of a frame with the effect that they have in a .g file: `contact`, `mass`, `color`, `q` and `limits`
/// change the frame; words that the library reads when they are needed (`friction`, `logical`, `ctrl_limits`, ...), and
/// unknown words, are stored. Returns warnings: one for each unknown word that is a near miss of a known one. Throws
/// ValueError, before anything changes, for words that only a file can interpret (`joint`, `shape`, `pose`, ...); the
/// message names the method instead.
std::vector<std::string> setAttributes(Frame& frame, const Graph& attributes);

/// The same for attributes as a .g file writes them:
///
///     setAttributes(drawer, "logical: { is_drawer }, friction: .5");
///
/// Throws ParseError.
std::vector<std::string> setAttributes(Frame& frame, const std::string& text);

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
