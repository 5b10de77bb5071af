// A libFuzzer target for one kind of mesh file, that of the extension FUZZ_EXTENSION. For any bytes, reading
// them gives a mesh whose triangles name its vertices, or an error of the library.
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/geometry/files/mesh_file.h"

using namespace kinegraph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string path =
      (std::filesystem::temp_directory_path() / ("kinegraph_fuzz_" + std::to_string(getpid()) + FUZZ_EXTENSION))
          .string();
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), std::streamsize(size));
  try {
    const Mesh mesh = readMeshFile(path);
    for (const auto& triangle : mesh.triangles) {
      if (*std::max_element(triangle.begin(), triangle.end()) >= mesh.vertices.size()) std::abort();
    }
    if (mesh.colors.size() > 1 && mesh.colors.size() != mesh.vertices.size()) std::abort();
    if (!mesh.texcoords.empty() && mesh.texcoords.size() != mesh.vertices.size()) std::abort();
    for (const TexturedTriangles& t : mesh.textures) {
      if (mesh.texcoords.empty() || t.count > mesh.triangles.size() || t.first > mesh.triangles.size() - t.count)
        std::abort();
    }
    for (const Vector3d& p : mesh.vertices) {
      if (!p.allFinite()) std::abort();
    }
  } catch (const FileError&) {
  }
  return 0;
}
