#include "kinegraph/perception/scene_observer.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/perception/occupancy_map.h"

namespace kinegraph {

namespace {

/// Whether an arm moves the shapes of a thing.
bool isInHand(const Config& scene, const std::string& name) {
  std::set<int> parts = {scene.getFrame(name).id()};
  for (const Frame& part : scene.getFrame(name).getSubtree()) parts.insert(part.id());
  const std::vector<KnownShape> shapes = knownShapes(scene, {});
  return std::any_of(shapes.begin(), shapes.end(),
                     [&](const KnownShape& shape) { return !shape.supports && parts.contains(shape.frame); });
}

}  // namespace

SceneObserver::SceneObserver(std::function<std::vector<DepthView>()> take, std::vector<std::string> frames,
                             RegisterOptions options, OccupancyMap* map, Unseen unseen)
    : take_(std::move(take)), frames_(std::move(frames)), options_(std::move(options)), map_(map), unseen_(unseen) {
  if (!take_) throw ValueError("SceneObserver: take is null; expected a function that returns depth images");
  options_.validate();
}

std::map<std::string, std::optional<Pose>> SceneObserver::observe(Config& scene) {
  std::vector<std::string> standing;
  for (const std::string& name : frames_) {
    if (!isInHand(scene, name)) standing.push_back(name);
  }
  const std::vector<DepthView> views = take_();
  SeenScene seen;
  if (!standing.empty()) seen = registerScene(scene, views, standing, options_);
  if (map_) {
    const std::vector<std::string> warnings = map_->update(scene, views, seen);
    for (const std::string& warning : warnings) seen.warnings.push_back(warning);
    map_->attach(scene, unseen_);
  }
  seen_ = std::move(seen);
  std::map<std::string, std::optional<Pose>> poses;
  for (const std::string& name : frames_) {
    const auto found = seen_.frames.find(name);
    const bool is_seen = found != seen_.frames.end() && found->second.status == SeenStatus::seen;
    poses[name] = is_seen ? std::optional(found->second.pose) : std::nullopt;
  }
  return poses;
}

}  // namespace kinegraph
