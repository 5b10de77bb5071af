#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// The surfaces of all shapes with triangles as one mesh in world coordinates (m), with a color per vertex: the mesh's
/// own, or the frame's, or gray.
Mesh worldMesh(const Config& config);

/// Writes a mesh as a binary PLY file with vertex colors. Throws FileError.
void writePly(const Mesh& mesh, const std::string& path);

/// Writes all surfaces of a scene into one PLY file, in world coordinates. Throws FileError, and ValueError for a scene
/// without surfaces.
void saveWorldMesh(const Config& config, const std::string& path);

/// Writes every mesh of a scene once as `<prefix><frame>.ply`, or `<prefix>mesh_<number>.ply` with `enumerate`, in its
/// frame's coordinates; shapes that share a mesh share the file. Folders are made. Returns the paths.
std::vector<std::string> saveMeshes(const Config& config, const std::string& prefix, bool enumerate = false);

/// Writes the convex hull of every mesh, drawn in by `shrink` (m) if that is positive, as `<prefix><frame>.stl`. Flat
/// meshes are left out. Folders are made. Returns the paths.
std::vector<std::string> saveConvexStls(const Config& config, const std::string& prefix, double shrink = -1.);

/// The tree of frames with poses, surfaces and colors as a COLLADA 1.4.1 text. Units m, z up.
std::string writeCollada(const Config& config);

/// Writes that into a file. Throws FileError.
void saveCollada(const Config& config, const std::string& path);

}  // namespace kinegraph
