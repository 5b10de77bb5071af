#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Merges the surfaces of all shapes with triangles into one mesh in world coordinates (m). Each vertex has a color:
/// the mesh's own, else the frame's, else gray.
Mesh worldMesh(const Config& config);

/// Writes a mesh as a binary PLY file with vertex colors. Throws FileError.
void writePly(const Mesh& mesh, const std::string& path);

/// Writes a mesh as a text file of Wavefront OBJ, with vertex colors behind the coordinates. Throws FileError.
void writeObj(const Mesh& mesh, const std::string& path);

/// Writes all surfaces of a scene to one file, in world coordinates. The suffix is .ply, .obj, or .stl (no colors).
/// Throws FileError, and ValueError for other suffixes and for a scene without surfaces.
void saveWorldMesh(const Config& config, const std::string& path);

/// Writes every mesh of a scene once, in its frame's coordinates, as `<prefix><frame>.ply`, or as
/// `<prefix>mesh_<number>.ply` with `enumerate`. Shapes that share a mesh share the file. Creates folders. Returns the
/// paths.
std::vector<std::string> saveMeshes(const Config& config, const std::string& prefix, bool enumerate = false);

/// Writes the convex hull of every mesh, shrunk by `shrink` (m) if that is positive, as `<prefix><frame>.stl`. Skips
/// flat meshes. Creates folders. Returns the paths.
std::vector<std::string> saveConvexStls(const Config& config, const std::string& prefix, double shrink = -1.);

/// The tree of frames with poses, surfaces and colors as a COLLADA 1.4.1 text. Units m, z up.
std::string writeCollada(const Config& config);

/// Writes writeCollada() to a file. Throws FileError.
void saveCollada(const Config& config, const std::string& path);

}  // namespace kinegraph
