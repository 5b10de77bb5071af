#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

/// Splits a mesh into its convex parts, each with its own vertices and triangles: the parts listed in the mesh, or else
/// the connected components of its triangles. Empty parts have no vertices.
std::vector<Mesh> convexParts(const Mesh& mesh);

/// Moves each convex part of the frame's mesh to a child `<name>_<i>`, as the convex hull of its points, with the
/// frame's color and contact flag; the frame itself loses its shape. Skips empty and flat parts. Returns the
/// children.
/// Throws ValueError for a frame without a mesh.
std::vector<Frame> splitIntoConvexParts(Frame& frame);

/// Replaces every mesh by its convex hull, shrunk by `radius` (m) and swept by a ball of that radius (ssCvx). Flat
/// meshes and point clouds are unchanged.
void makeMeshesConvex(SceneTree& scene, double radius);

/// Returns the vertices of a hull with faces shrunk by `distance` (m). Each vertex moves against the mean of the
/// adjacent face normals, by at most half its distance to the middle of the hull.
std::vector<Vector3d> shrunkHull(const Mesh& hull, double distance);

/// Adds a frame with the content of an HDF5 object file: its inertia (inertia/mass, com, tensor), and children `_mesh`,
/// `_pts` and `_decomp` for the groups mesh, points and decomp. The convex parts below `_decomp` collide. Throws
/// FileError; the configuration is then unchanged.
Frame addH5Object(Config& config, const std::string& name, const std::string& path);

}  // namespace kinegraph::inline scene_internal
