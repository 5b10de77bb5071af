#include "kinegraph/exporters/stl_writer.h"

#include <bit>
#include <cstring>
#include <fstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline exporters_internal {

namespace {

static_assert(std::endian::native == std::endian::little, "STL files are little-endian");

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

void append(std::string& bytes, const Vector3d& v) {
  for (int i = 0; i < 3; ++i) append(bytes, float(v[i]));
}

}  // namespace

void writeStl(const Mesh& mesh, const std::string& path) {
  std::string bytes(80, '\0');
  append(bytes, std::uint32_t(mesh.triangles.size()));
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3d &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    const Vector3d normal = (b - a).cross(c - a);
    append(bytes, Vector3d(normal.norm() > 0. ? normal.normalized() : normal));
    append(bytes, a);
    append(bytes, b);
    append(bytes, c);
    append(bytes, std::uint16_t(0));
  }
  std::ofstream stream(path, std::ios::binary);
  stream.write(bytes.data(), std::streamsize(bytes.size()));
  if (!stream) throw FileError(cat("mesh file '", path, "' cannot be written"));
}

}  // namespace kinegraph::inline exporters_internal
