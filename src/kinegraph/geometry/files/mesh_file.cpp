#include "kinegraph/geometry/files/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <unordered_map>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/assimp.h"
#include "kinegraph/geometry/files/h5_file.h"
#include "kinegraph/geometry/files/mesh_header.h"
#include "kinegraph/geometry/files/mesh_textures.h"
#include "kinegraph/geometry/shapes/scale_mesh.h"

namespace kinegraph::inline geometry_internal {

namespace {

std::array<std::uint8_t, 4> bytes(const aiColor4D& color) {
  const auto byte = [](float x) { return std::uint8_t(std::lround(255.f * std::clamp(x, 0.f, 1.f))); };
  return {byte(color.r), byte(color.g), byte(color.b), byte(color.a)};
}

/// The bits of a vertex: vertices with equal bits are joined.
struct VertexKey {
  std::array<float, 5> numbers;  ///< position and texture coordinates
  std::array<std::uint8_t, 4> color;

  bool operator==(const VertexKey& other) const {
    return std::memcmp(numbers.data(), other.numbers.data(), sizeof(numbers)) == 0 && color == other.color;
  }
};
struct VertexKeyHash {
  std::size_t operator()(const VertexKey& key) const {
    std::array<char, sizeof(key.numbers) + sizeof(key.color)> bytes;
    std::memcpy(bytes.data(), key.numbers.data(), sizeof(key.numbers));
    std::memcpy(bytes.data() + sizeof(key.numbers), key.color.data(), sizeof(key.color));
    return std::hash<std::string_view>()({bytes.data(), bytes.size()});
  }
};

/// Returns the color of a material in the file. Nothing for a material that assimp has added because a part has none:
/// it is named "DefaultMaterial", or white (glTF) or gray (OFF) without a name.
std::optional<aiColor4D> colorOf(const aiScene& scene, unsigned index) {
  if (index >= scene.mNumMaterials) return std::nullopt;
  const aiMaterial* material = scene.mMaterials[index];
  aiString name;
  aiColor4D color;
  if (assimp().aiGetMaterialColor(material, AI_MATKEY_COLOR_DIFFUSE, &color) != aiReturn_SUCCESS) return std::nullopt;
  assimp().aiGetMaterialString(material, AI_MATKEY_NAME, &name);
  const std::string_view named = name.C_Str();
  const bool is_plain = color == aiColor4D(1.f, 1.f, 1.f, 1.f) || color == aiColor4D(.6f, .6f, .6f, 1.f);
  if (named == AI_DEFAULT_MATERIAL_NAME || (named.empty() && is_plain)) return std::nullopt;
  return color;
}

/// Returns whether a file has materials of its own: those of an OBJ file are in another file, which may be missing.
bool hasMaterials(const std::string& extension, const std::vector<std::string>& opened) {
  return extension != ".obj" || std::any_of(opened.begin(), opened.end(), [](const std::string& path) {
           std::error_code error;
           return lowerExtension(path) == ".mtl" && std::filesystem::is_regular_file(path, error);
         });
}

/// The colors of the parts of a mesh: of their vertices, else of their materials.
struct PartColors {
  bool from_materials;
  bool any = false;  ///< a part has a color

  std::optional<aiColor4D> of(const aiScene& scene, const aiMesh& part) {
    const auto color = from_materials ? colorOf(scene, part.mMaterialIndex) : std::nullopt;
    any = any || color || part.HasVertexColors(0);
    return color;
  }
};

void append(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above, MeshTextures& textures,
            PartColors& part_colors, Mesh& mesh) {
  const aiMatrix4x4 transform = above * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[m]];
    const aiColor4D diffuse = part_colors.of(scene, part).value_or(aiColor4D(.8f, .8f, .8f, 1.f));
    const std::uint32_t first = std::uint32_t(mesh.vertices.size());
    const bool textured = part.HasTextureCoords(0);
    std::unordered_map<VertexKey, std::uint32_t, VertexKeyHash> places;
    places.reserve(part.mNumVertices);
    std::vector<std::uint32_t> place_of(part.mNumVertices);
    std::vector<std::array<float, 2>> coordinates;
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D& own = part.mVertices[v];
      VertexKey key{{own.x + 0.f, own.y + 0.f, own.z + 0.f, 0.f, 0.f},
                    bytes(part.HasVertexColors(0) ? part.mColors[0][v] : diffuse)};
      if (textured) key.numbers[3] = part.mTextureCoords[0][v].x, key.numbers[4] = part.mTextureCoords[0][v].y;
      const auto [place, is_new] = places.try_emplace(key, std::uint32_t(mesh.vertices.size()));
      place_of[v] = place->second;
      if (!is_new) continue;
      const aiVector3D p = transform * own;
      mesh.vertices.emplace_back(p.x, p.y, p.z);
      mesh.colors.push_back(key.color);
      if (textured) coordinates.push_back({key.numbers[3], key.numbers[4]});
    }
    const std::size_t first_triangle = mesh.triangles.size();
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices == 3)
        mesh.triangles.push_back({place_of[face.mIndices[0]], place_of[face.mIndices[1]], place_of[face.mIndices[2]]});
    }
    if (transform.Determinant() < 0.f) turnTriangles(mesh, first_triangle);
    if (!textured) continue;
    addTexture(mesh, first, coordinates, first_triangle, textures.of(part.mMaterialIndex));
  }
  for (unsigned child = 0; child < node.mNumChildren; ++child)
    append(scene, *node.mChildren[child], transform, textures, part_colors, mesh);
}

/// Removes the vertices that belong to no triangle, if there are triangles: loose points, and ends of lines, are no
/// part of a surface.
void removeLoosePoints(Mesh& mesh) {
  if (mesh.triangles.empty()) return;
  std::vector<std::uint32_t> place(mesh.vertices.size(), 0);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) place[corner] = 1;
  }
  if (std::find(place.begin(), place.end(), 0u) == place.end()) return;
  std::uint32_t kept = 0;
  const bool colored = mesh.colors.size() == mesh.vertices.size(),
             textured = mesh.texcoords.size() == mesh.vertices.size();
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] == 0) continue;
    mesh.vertices[kept] = mesh.vertices[v];
    if (colored) mesh.colors[kept] = mesh.colors[v];
    if (textured) mesh.texcoords[kept] = mesh.texcoords[v];
    place[v] = kept++;
  }
  mesh.vertices.resize(kept);
  if (colored) mesh.colors.resize(kept);
  if (textured) mesh.texcoords.resize(kept);
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) corner = place[corner];
  }
}

}  // namespace

Mesh readH5Mesh(const std::string& path, const std::string& group) {
  if (!std::filesystem::is_regular_file(path)) throw FileError(cat("mesh file '", path, "' does not exist"));
  const H5File file(path);
  const auto table = [&](const std::string& name, std::uint64_t at_least, std::uint64_t at_most) {
    H5Dataset data = file.dataset(cat(group, "/", name));
    if (data.dims.size() != 2 || data.dims[1] < at_least || data.dims[1] > at_most) {
      throw FileError(cat("mesh file '", path, "': '", group, "/", name, "' is not a table of ", at_least, " columns"));
    }
    return data;
  };
  Mesh mesh;
  const H5Dataset vertices = table("vertices", 3, 3);
  const std::vector<double>& v = vertices.numbers;
  for (std::size_t i = 0; i < v.size(); i += 3) mesh.vertices.emplace_back(v[i], v[i + 1], v[i + 2]);
  if (file.contains(cat(group, "/faces"))) {
    const std::vector<double> f = table("faces", 3, 3).numbers;
    for (std::size_t i = 0; i < f.size(); ++i) {
      if (!(f[i] >= 0. && f[i] < double(mesh.vertices.size()))) {
        throw FileError(cat("mesh file '", path, "': a face refers to vertex ", f[i], " of ", mesh.vertices.size()));
      }
    }
    for (std::size_t i = 0; i < f.size(); i += 3)
      mesh.triangles.push_back({std::uint32_t(f[i]), std::uint32_t(f[i + 1]), std::uint32_t(f[i + 2])});
  }
  if (file.contains(cat(group, "/colors"))) {
    const H5Dataset colors = table("colors", 3, 4);
    const std::size_t columns = colors.dims[1];
    const auto byte = [](double x) { return std::uint8_t(std::lround(std::clamp(x, 0., 255.))); };
    for (std::size_t i = 0; i < colors.numbers.size(); i += columns) {
      const double* c = colors.numbers.data() + i;
      mesh.colors.push_back({byte(c[0]), byte(c[1]), byte(c[2]), columns == 4 ? byte(c[3]) : std::uint8_t(255)});
    }
    if (mesh.colors.size() != 1 && mesh.colors.size() != mesh.vertices.size()) mesh.colors.clear();
  }
  const std::string texture = cat(group, "/textureFile"), coordinates = cat(group, "/textureCoords");
  if (file.contains(coordinates)) {  // to the right and down
    const H5Dataset uv = table("textureCoords", 2, 2);
    std::vector<std::array<float, 2>> list;
    for (std::size_t i = 0; i < uv.numbers.size(); i += 2)
      list.push_back({float(uv.numbers[i]), float(1. - uv.numbers[i + 1])});
    std::string name;
    if (file.contains(texture)) {
      for (const double letter : file.dataset(texture).numbers) {
        if (letter > 0. && letter < 128.) name += char(letter);
      }
    }
    if (list.size() == mesh.vertices.size()) addTexture(mesh, 0, list, 0, imageBeside(path, name));
  }
  if (file.contains(cat(group, "/parts"))) {
    for (double part : file.dataset(cat(group, "/parts")).numbers) {
      if (!(part >= 0. && part <= double(mesh.vertices.size()))) {
        throw FileError(
            cat("mesh file '", path, "': a convex part starts at vertex ", part, " of ", mesh.vertices.size()));
      }
      mesh.parts.push_back(std::uint32_t(part));
    }
    std::sort(mesh.parts.begin(), mesh.parts.end());
  }
  return mesh;
}

std::string readMeshBytes(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw FileError(cat("mesh file '", path, "' does not exist"));
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(std::size_t(std::filesystem::file_size(path, error)), '\0');
  if (!stream.read(bytes.data(), std::streamsize(bytes.size())) || error)
    throw FileError(cat("mesh file '", path, "' cannot be read"));
  return bytes;
}

Mesh readMeshFile(const std::string& path, std::vector<std::string>* files) {
  const std::string content = readMeshBytes(path), extension = lowerExtension(path);
  if (files) files->push_back(path);
  if (content.empty()) throw FileError(cat("mesh file '", path, "' is empty"));
  if (content.starts_with("version https://git-lfs.github.com"))
    throw FileError(cat("mesh file '", path, "' is a Git LFS pointer; 'git lfs pull' fetches the mesh"));
  if (extension == ".h5") return readH5Mesh(path, "mesh");
  if (extension == ".msh") return readMshMesh(path);
  if (extension == ".tri") return readTriMesh(path);
  Mesh mesh;
  if (extension == ".stl") {
    mesh = readStlMesh(content, path);
  } else {
    checkMeshHeader(path);
    std::vector<std::string> opened;
    const AssimpScene scene = readAssimpScene(path, &opened);
    if (files) files->insert(files->end(), opened.begin(), opened.end());
    MeshTextures textures(*scene, path, files);
    PartColors part_colors{hasMaterials(extension, opened)};
    append(*scene, *scene->mRootNode, aiMatrix4x4(), textures, part_colors, mesh);
    if (!part_colors.any) mesh.colors.clear();
    mesh.texcoords.resize(mesh.texcoords.empty() ? 0 : mesh.vertices.size());
  }
  removeLoosePoints(mesh);
  if (mesh.vertices.empty()) throw FileError(cat("mesh file '", path, "' contains no vertices"));
  const auto broken =
      std::find_if_not(mesh.vertices.begin(), mesh.vertices.end(), [](const Vector3d& p) { return p.allFinite(); });
  if (broken != mesh.vertices.end()) {
    throw FileError(cat("mesh file '", path, "': vertex ", broken - mesh.vertices.begin(), " is (", broken->transpose(),
                        "); coordinates must be finite"));
  }
  return mesh;
}

}  // namespace kinegraph::inline geometry_internal
