#pragma once

#include <array>
#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Colors of points, 0..255: for each one, one for all, or none.
using PointColors = std::vector<std::array<std::uint8_t, 4>>;

/// Line segments between consecutive pairs of points (m), or with `connected` one line through all of them. Throws
/// ValueError for an odd number of points, fewer than two, or a number of colors that does not fit.
void setLines(Frame& frame, const std::vector<Vector3d>& points, const PointColors& colors = {},
              bool connected = false);

/// The mesh of a file, its points multiplied by `scale`. Throws FileError; the frame is then unchanged.
void setMeshFile(Frame& frame, const std::string& path, double scale = 1.);

/// Covers the frame's shape with a picture (PNG or JPEG). With `texcoords`, two numbers per vertex of its mesh: where
/// each is in the picture, to the right and up, in 0..1. Throws FileError for the file, ValueError for a frame without
/// a shape and for coordinates that do not fit; the frame is then unchanged.
void setTexture(Frame& frame, const std::string& path, const std::vector<double>& texcoords = {});

/// A box of that size (m) that holds a grid of numbers.
void setTensor(Frame& frame, Grid grid, const Vector3d& size);

/// Gives the frame the solid where the values of a grid in a box of that size (m) are not positive; outside, they are
/// its distance (m). Throws ValueError for a grid or a size that is not good.
void setSdf(Frame& frame, Grid grid, const Vector3d& size);

/// The surface where a grid of numbers, which fills a box of that size (m), is zero; normals point to larger values.
/// First the grid is blurred that often, and with `resample` > 0 it is resampled to cells of about that size (m).
void setImplicitSurface(Frame& frame, const Grid& grid, const Vector3d& size, int blur = 0, double resample = -1.);

/// The convex parts of a mesh as vertices and triangles of their own: those that it names, or what its triangles
/// connect. Parts that are empty have no vertices.
std::vector<Mesh> convexParts(const Mesh& mesh);

/// Gives each convex part of the frame's mesh to a child `<name>_<i>`, as the convex hull of its points, with the
/// frame's color and contact flag; the frame itself loses its shape. Empty and flat parts are left out. Returns the
/// children. Throws ValueError for a frame without a mesh.
std::vector<Frame> splitIntoConvexParts(Frame& frame);

/// Replaces every mesh by its convex hull, drawn in by `radius` (m) and swept by a ball of that radius (ssCvx). Flat
/// meshes and point clouds stay as they are.
void makeMeshesConvex(SceneTree& scene, double radius);

/// A hull whose faces are moved inwards by `distance` (m), as far as it has room for that: each point moves along the
/// mean of the normals around it, at most to half way to the middle.
std::vector<Vector3d> drawnIn(const Mesh& hull, double distance);

/// Adds a frame that carries what an HDF5 file of an object holds: its inertia (inertia/mass, com, tensor), and
/// children
/// `_mesh`, `_pts` and `_decomp` (with the convex parts below it, which collide) for the groups mesh, points and
/// decomp. Throws FileError; the configuration is then unchanged.
Frame addH5Object(Config& config, const std::string& name, const std::string& path);

}  // namespace kinegraph
