#include "kinegraph/geometry/files/mesh_cache.h"

#include <algorithm>
#include <functional>
#include <list>
#include <map>
#include <mutex>

#include "kinegraph/common/file_stamp.h"
#include "kinegraph/geometry/files/mesh_file.h"

namespace kinegraph {

namespace {

constexpr std::size_t kMaxCachedBytes = std::size_t(256) << 20;

struct CachedMesh {
  std::string path;
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
  std::shared_ptr<const Mesh> find(const std::string& path, std::size_t hash) {
    const std::lock_guard lock(mutex_);
    const auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const CachedMesh& e) {
      return e.hash == hash && e.path == path && std::all_of(e.beside.begin(), e.beside.end(), [](const auto& file) {
               return stampOf(file.first) == file.second;
             });
    });
    if (entry == entries_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, entry);
    return entry->mesh;
  }

  void add(CachedMesh entry) {
    const std::lock_guard lock(mutex_);
    const auto is_older = [&](const CachedMesh& e) {
      if (e.path != entry.path) return false;
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

std::shared_ptr<const Mesh> sharedMeshFile(const std::string& path) {
  const std::size_t hash = std::hash<std::string>()(readMeshBytes(path));
  if (auto mesh = meshCache().find(path, hash)) return mesh;
  std::vector<std::string> files;
  auto mesh = std::make_shared<const Mesh>(readMeshFile(path, &files));
  CachedMesh entry{path, hash, {}, mesh, bytesOf(*mesh)};
  for (std::string& file : files) {
    if (file != path) entry.beside[file] = stampOf(file);
  }
  meshCache().add(std::move(entry));
  return mesh;
}

}  // namespace kinegraph
