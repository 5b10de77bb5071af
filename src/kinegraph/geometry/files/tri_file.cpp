#include <filesystem>
#include <fstream>
#include <locale>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/mesh_file.h"

namespace kinegraph::inline geometry_internal {

Mesh readTriMesh(const std::string& path) {
  std::ifstream in(path);
  in.imbue(std::locale::classic());
  const auto refuse = [&](const std::string& why) { throw FileError(cat("mesh file '", path, "': ", why)); };
  std::string word;
  long vertices = 0, triangles = 0;
  if (!(in >> word) || word != "TRI") refuse(cat("expected TRI at the start, found '", word, "'"));
  if (!(in >> vertices >> triangles) || vertices <= 0 || triangles < 0)
    refuse("expected the numbers of vertices and of triangles after TRI");
  // A number and a blank take two bytes: announced counts are at most those that fit.
  if (double(vertices + triangles) * 6. > double(std::filesystem::file_size(path)))
    refuse(cat("it announces ", vertices, " vertices and ", triangles, " triangles, more than its bytes can have"));
  Mesh mesh;
  for (long i = 0; i < vertices; ++i) {
    Vector3d p;
    if (!(in >> p[0] >> p[1] >> p[2])) refuse(cat("vertex ", i, " of ", vertices, " has no three coordinates"));
    mesh.vertices.emplace_back(p[0], p[1], p[2]);
  }
  for (long i = 0; i < triangles; ++i) {
    long corners[3];
    if (!(in >> corners[0] >> corners[1] >> corners[2]))
      refuse(cat("triangle ", i, " of ", triangles, " has no three vertices"));
    for (const long corner : corners) {
      if (corner < 0 || corner >= vertices) refuse(cat("triangle ", i, " refers to vertex ", corner, " of ", vertices));
    }
    mesh.triangles.push_back({std::uint32_t(corners[0]), std::uint32_t(corners[1]), std::uint32_t(corners[2])});
  }
  return mesh;
}

}  // namespace kinegraph::inline geometry_internal
