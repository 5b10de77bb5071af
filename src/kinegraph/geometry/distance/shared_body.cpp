#include "kinegraph/geometry/distance/shared_body.h"

#include <map>
#include <mutex>
#include <tuple>
#include <vector>

namespace kinegraph::inline geometry_internal {

namespace {

constexpr std::size_t kFewBodies = 64;

/// The body of a mesh, built once by the first thread that wants it.
struct SharedBody {
  std::mutex mutex;
  std::weak_ptr<const Mesh> mesh;
  std::weak_ptr<const CollisionBody> body;
};

class SharedBodies {
 public:
  std::shared_ptr<SharedBody> find(const Geometry& geometry) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<SharedBody>& entry = bodies_[{geometry.mesh.get(), geometry.type, geometry.size}];
    if (!entry || entry->mesh.lock() != geometry.mesh) {  // new, or at the address of a mesh that is gone
      entry = std::make_shared<SharedBody>();
      entry->mesh = geometry.mesh;
    }
    const std::shared_ptr<SharedBody> found = entry;
    if (bodies_.size() > most_) {
      std::erase_if(bodies_, [](const auto& other) { return other.second->mesh.expired(); });
      most_ = 2 * bodies_.size() + kFewBodies;
    }
    return found;
  }

 private:
  std::mutex mutex_;
  std::map<std::tuple<const Mesh*, ShapeType, std::vector<double>>, std::shared_ptr<SharedBody>> bodies_;
  std::size_t most_ = kFewBodies;
};

SharedBodies& sharedBodies() {
  static SharedBodies bodies;
  return bodies;
}

bool isShared(const Geometry& geometry) { return geometry.mesh && !geometry.grid; }

}  // namespace

std::shared_ptr<const CollisionBody> sharedCollisionBody(const Geometry& geometry) {
  if (!isShared(geometry)) return makeCollisionBody(geometry);
  const std::shared_ptr<SharedBody> shared = sharedBodies().find(geometry);
  const std::lock_guard lock(shared->mutex);
  std::shared_ptr<const CollisionBody> body = shared->body.lock();
  if (!body) shared->body = body = makeCollisionBody(geometry);
  return body;
}

bool hasSharedBody(const Geometry& geometry) {
  if (!isShared(geometry)) return false;
  const std::shared_ptr<SharedBody> shared = sharedBodies().find(geometry);
  const std::lock_guard lock(shared->mutex);
  return !shared->body.expired();
}

}  // namespace kinegraph::inline geometry_internal
