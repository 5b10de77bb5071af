#include "kinegraph/geometry/files/mesh_cache.h"

#include <algorithm>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <optional>

#include "kinegraph/common/file_stamp.h"
#include "kinegraph/geometry/files/mesh_file.h"
#include "kinegraph/geometry/shapes/scale_mesh.h"

namespace kinegraph::inline geometry_internal {

namespace {

constexpr std::size_t kMaxCachedBytes = std::size_t(256) << 20;

struct CachedMesh {
  std::string path;
  Vector3d scale;
  std::size_t hash;  ///< of the file's bytes: times of files are too coarse for quick successions
  std::map<std::string, FileStamp> beside;  ///< stamps of files that it refers to
  std::shared_ptr<const Mesh> mesh;
  std::size_t bytes;
};

std::size_t bytesOf(const Mesh& mesh) {
  std::size_t bytes = 24 * mesh.vertices.size() + 12 * mesh.triangles.size() + 4 * mesh.colors.size() +
                      8 * mesh.texcoords.size() + 4 * mesh.parts.size();
  for (const TexturedTriangles& part : mesh.textures) bytes += part.image->bytes.size();
  return bytes;
}

class MeshCache {
 public:
  std::optional<CachedMesh> find(const std::string& path, const Vector3d& scale, std::size_t hash) {
    const std::lock_guard lock(mutex_);
    const auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const CachedMesh& e) {
      const auto is_current = [](const auto& file) { return stampOf(file.first) == file.second; };
      return e.hash == hash && e.path == path && e.scale == scale && std::ranges::all_of(e.beside, is_current);
    });
    if (entry == entries_.end()) return std::nullopt;
    entries_.splice(entries_.begin(), entries_, entry);
    return *entry;
  }

  void add(CachedMesh entry) {
    const std::lock_guard lock(mutex_);
    const auto is_older = [&](const CachedMesh& e) {
      if (e.path != entry.path || (e.hash == entry.hash && e.scale != entry.scale)) return false;
      bytes_ -= e.bytes;
      return true;
    };
    entries_.remove_if(is_older);
    bytes_ += entry.bytes;
    entries_.push_front(std::move(entry));
    while (bytes_ > kMaxCachedBytes) {
      bytes_ -= entries_.back().bytes;
      entries_.pop_back();
    }
  }

 private:
  std::mutex mutex_;
  std::list<CachedMesh> entries_;  ///< the one used last first
  std::size_t bytes_ = 0;
};

MeshCache& meshCache() {
  static MeshCache cache;
  return cache;
}

}  // namespace

std::shared_ptr<const Mesh> sharedMeshFile(const std::string& path, const Vector3d& scale) {
  const Vector3d one = Vector3d::Ones();
  const std::size_t hash = std::hash<std::string>()(readMeshBytes(path));
  if (const auto known = meshCache().find(path, scale, hash)) return known->mesh;
  auto entry = scale == one ? std::nullopt : meshCache().find(path, one, hash);
  if (!entry) {
    std::vector<std::string> files;
    const auto mesh = std::make_shared<const Mesh>(readMeshFile(path, &files));
    entry = CachedMesh{path, one, hash, {}, mesh, bytesOf(*mesh)};
    for (std::string& file : files) {
      if (file != path) entry->beside[file] = stampOf(file);
    }
  }
  if (scale != one) {
    Mesh scaled = *entry->mesh;
    scaleMesh(scaled, scale);
    entry->mesh = std::make_shared<const Mesh>(std::move(scaled));
    entry->scale = scale;
  }
  meshCache().add(*entry);
  return entry->mesh;
}

}  // namespace kinegraph::inline geometry_internal
