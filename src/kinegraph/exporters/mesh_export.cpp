#include "kinegraph/exporters/writers.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/exporters/stl_writer.h"
#include "kinegraph/geometry/shapes/convex_hull.h"
#include "kinegraph/geometry/shapes/tessellation.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/convex_parts.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

using Rgba = std::array<std::uint8_t, 4>;

Rgba bytes(const Vector4d& color) {
  Rgba rgba;
  for (int i = 0; i < 4; ++i) rgba[i] = std::uint8_t(std::lround(255. * std::clamp(color[i], 0., 1.)));
  return rgba;
}

void addTransformed(const Mesh& part, const RigidTransform& X, const Rgba& color, Mesh& sum) {
  const auto first = std::uint32_t(sum.vertices.size());
  for (std::size_t v = 0; v < part.vertices.size(); ++v) {
    sum.vertices.push_back(X * part.vertices[v]);
    sum.colors.push_back(part.colors.size() == part.vertices.size() ? part.colors[v]
                         : part.colors.size() == 1                  ? part.colors[0]
                                                                    : color);
  }
  for (const auto& [a, b, c] : part.triangles) sum.triangles.push_back({first + a, first + b, first + c});
}

/// Replaces characters other than letters, digits, '-' and '.' by '_'.
std::string fileName(std::string name) {
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';
  }
  return name.empty() ? "frame" : name;
}

void makeFolder(const std::string& prefix) {
  const std::filesystem::path folder = std::filesystem::path(prefix + "x").parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw FileError(cat("the folder '", folder.string(), "' cannot be created: ", error.message()));
}

/// Calls `save(mesh, name)` once for each distinct mesh of a scene, with a unique name.
template <class Save>
std::vector<std::string> forEachMesh(const Config& config, const std::string& prefix, bool enumerate,
                                     const char* extension, Save save) {
  makeFolder(prefix);
  std::map<const Mesh*, bool> seen;
  std::map<std::string, int> taken;
  std::vector<std::string> paths;
  for (const auto& frame : config.scene()->frames()) {
    if (!frame->shape || frame->shape->geometry->type != ShapeType::mesh) continue;
    const std::shared_ptr<const Mesh>& mesh = frame->shape->geometry->mesh;
    if (!mesh || mesh->triangles.empty() || seen[mesh.get()]) continue;
    seen[mesh.get()] = true;
    std::string name = enumerate ? cat("mesh_", paths.size()) : fileName(frame->name);
    if (const int before = taken[name]++; before > 0) name = cat(name, "_", before + 1);
    const std::string path = prefix + name + extension;
    if (save(*mesh, path)) paths.push_back(path);
  }
  return paths;
}

}  // namespace

Mesh worldMesh(const Config& config) {
  Mesh sum;
  const State& state = config.state();
  for (const auto& frame : config.scene()->frames()) {
    if (!frame->shape) continue;
    const Mesh part = tessellate(*frame->shape->geometry);
    if (part.triangles.empty()) continue;
    addTransformed(part, state.pose(frame->id), bytes(frame->shape->color.value_or(Vector4d(.8, .8, .8, 1.))), sum);
  }
  return sum;
}

void writePly(const Mesh& mesh, const std::string& path) {
  std::string data = cat("ply\nformat binary_little_endian 1.0\nelement vertex ", mesh.vertices.size(),
                         "\nproperty float x\nproperty float y\nproperty float z\n");
  const bool one_color = mesh.colors.size() == 1, colored = one_color || mesh.colors.size() == mesh.vertices.size();
  if (colored) data += "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
  data += cat("element face ", mesh.triangles.size(), "\nproperty list uchar int vertex_indices\nend_header\n");
  const auto add = [&](const auto& value) {
    const char* bytes = reinterpret_cast<const char*>(&value);
    data.append(bytes, sizeof(value));
  };
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (double x : mesh.vertices[v]) add(float(x));
    if (colored) add(mesh.colors[one_color ? 0 : v]);
  }
  for (const auto& triangle : mesh.triangles) {
    add(std::uint8_t(3));
    for (std::uint32_t v : triangle) add(std::int32_t(v));
  }
  std::ofstream stream(path, std::ios::binary);
  stream << data;
  stream.flush();
  if (!stream) throw FileError(cat("mesh file '", path, "' cannot be written"));
}

void writeObj(const Mesh& mesh, const std::string& path) {
  const bool one_color = mesh.colors.size() == 1, colored = one_color || mesh.colors.size() == mesh.vertices.size();
  std::string data;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    data += "v";
    for (double x : mesh.vertices[v]) data += " " + numberText(x, 9);
    for (std::size_t i = 0; colored && i < 3; ++i)
      data += " " + numberText(mesh.colors[one_color ? 0 : v][i] / 255., 4);
    data += "\n";
  }
  for (const auto& [a, b, c] : mesh.triangles) data += cat("f ", a + 1, " ", b + 1, " ", c + 1, "\n");
  std::ofstream stream(path, std::ios::binary);
  stream << data;
  stream.flush();
  if (!stream) throw FileError(cat("mesh file '", path, "' cannot be written"));
}

void saveWorldMesh(const Config& config, const std::string& path) {
  const std::map<std::string, void (*)(const Mesh&, const std::string&)> writers = {
      {".ply", writePly}, {".obj", writeObj}, {".stl", writeStl}};
  const std::string extension = lowerExtension(path);
  const auto writer = writers.find(extension);
  if (writer == writers.end())
    throw ValueError(cat("writeMesh: the suffix of '", path, "' is ",
                         extension.empty() ? "missing" : cat("'", extension, "'"), "; expected .ply, .obj or .stl",
                         extension == ".dae"                           ? "; writeCollada writes COLLADA"
                         : extension == ".glb" || extension == ".gltf" ? "; writeGltf writes glTF"
                                                                       : ""));
  const Mesh mesh = worldMesh(config);
  if (mesh.triangles.empty()) throw ValueError("writeMesh: no shape of the configuration has a surface");
  writer->second(mesh, path);
}

std::vector<std::string> saveMeshes(const Config& config, const std::string& prefix, bool enumerate) {
  return forEachMesh(config, prefix, enumerate, ".ply", [](const Mesh& mesh, const std::string& path) {
    writePly(mesh, path);
    return true;
  });
}

std::vector<std::string> saveConvexStls(const Config& config, const std::string& prefix, double shrink) {
  return forEachMesh(config, prefix, false, ".stl", [&](const Mesh& mesh, const std::string& path) {
    if (mesh.vertices.size() < 4 || !spanVolume(mesh.vertices)) return false;
    Mesh hull = convexHull(mesh.vertices);
    if (shrink > 0.) hull = convexHull(shrunkHull(hull, shrink));
    writeStl(hull, path);
    return true;
  });
}

}  // namespace kinegraph
