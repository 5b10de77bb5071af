#include "kinegraph/geometry/files/mesh_textures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "kinegraph/common/errors.h"
#include "kinegraph/geometry/files/assimp.h"
#include "kinegraph/geometry/files/image_file.h"

namespace kinegraph::inline geometry_internal {

std::shared_ptr<const Image> imageBeside(const std::string& mesh_path, const std::string& name,
                                         std::vector<std::string>* files) {
  namespace fs = std::filesystem;
  if (name.empty() || name.find('\0') != std::string::npos) return nullptr;
  std::string plain = name.starts_with("file://") ? name.substr(7) : name;
  std::replace(plain.begin(), plain.end(), '\\', '/');
  const fs::path folder = fs::path(mesh_path).parent_path();
  for (const fs::path& path : {folder / plain, folder / fs::path(plain).filename()}) {
    std::error_code ignored;
    if (files) files->push_back(path.string());
    if (!fs::is_regular_file(path, ignored)) continue;
    try {
      return readImageFile(path.string());
    } catch (const FileError&) {  // another kind of file
      return nullptr;
    }
  }
  return nullptr;
}

std::shared_ptr<const Image> MeshTextures::of(unsigned material) {
  const auto [place, is_new] = images_.try_emplace(material);
  if (is_new) place->second = read(material);
  return place->second;
}

std::shared_ptr<const Image> MeshTextures::read(unsigned material) const {
  if (material >= scene_.mNumMaterials) return nullptr;
  aiString name;
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    const aiReturn found = assimp().aiGetMaterialTexture(scene_.mMaterials[material], type, 0, &name, nullptr, nullptr,
                                                         nullptr, nullptr, nullptr, nullptr);
    if (found != aiReturn_SUCCESS) continue;
    const aiTexture* inside = scene_.GetEmbeddedTexture(name.C_Str());
    if (!inside) return imageBeside(mesh_path_, name.C_Str(), files_);
    if (inside->mHeight != 0 || inside->mWidth == 0) return nullptr;  // not compressed
    auto image = std::make_shared<Image>();
    image->bytes.assign(reinterpret_cast<const char*>(inside->pcData), inside->mWidth);
    return isImage(image->bytes) ? image : nullptr;
  }
  return nullptr;
}

void addTexture(Mesh& mesh, std::size_t first_vertex, const std::vector<std::array<float, 2>>& coordinates,
                std::size_t first_triangle, std::shared_ptr<const Image> image) {
  mesh.texcoords.resize(first_vertex);
  for (const auto& [u, v] : coordinates)
    mesh.texcoords.push_back({std::isfinite(u) ? u : 0.f, std::isfinite(v) ? v : 0.f});
  if (!image || mesh.triangles.size() == first_triangle) return;
  mesh.textures.push_back(
      {std::uint32_t(first_triangle), std::uint32_t(mesh.triangles.size() - first_triangle), std::move(image)});
}

}  // namespace kinegraph::inline geometry_internal
