#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/mesh_file.h"

namespace kinegraph::inline geometry_internal {

Mesh readMshMesh(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  std::int32_t counts[4] = {};  // of vertices, normals, texture coordinates, faces
  if (bytes.size() >= sizeof(counts)) std::memcpy(counts, bytes.data(), sizeof(counts));
  const auto [vertices, normals, texture, faces] = counts;
  const double expected = 16. + 12. * vertices + 12. * normals + 8. * texture + 12. * faces;
  if (vertices <= 0 || normals < 0 || texture < 0 || faces < 0 || double(bytes.size()) != expected) {
    throw FileError(cat("mesh file '", path, "' of ", bytes.size(),
                        " bytes is not a MuJoCo mesh: its header announces ", vertices, " vertices, ", normals,
                        " normals, ", texture, " texture coordinates and ", faces, " faces"));
  }
  Mesh mesh;
  const char* at = bytes.data() + sizeof(counts);
  for (int i = 0; i < vertices; ++i, at += 12) {
    float p[3];
    std::memcpy(p, at, sizeof(p));
    mesh.vertices.emplace_back(p[0], p[1], p[2]);
    if (!mesh.vertices.back().allFinite()) {
      throw FileError(cat("mesh file '", path, "': vertex ", i, " is (", mesh.vertices.back().transpose(),
                          "); coordinates must be finite"));
    }
  }
  at += 12 * std::ptrdiff_t(normals) + 8 * std::ptrdiff_t(texture);
  for (int i = 0; i < faces; ++i, at += 12) {
    std::uint32_t corners[3];
    std::memcpy(corners, at, sizeof(corners));
    for (const std::uint32_t corner : corners) {
      if (corner >= std::uint32_t(vertices))
        throw FileError(cat("mesh file '", path, "': face ", i, " refers to vertex ", corner, " of ", vertices));
    }
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return mesh;
}

}  // namespace kinegraph::inline geometry_internal
